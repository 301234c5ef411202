/// @file bench_row_command.cpp
/// The subcommand of an entry of fx bench.

#include "benchmarks/bench/bench_row.h"
#include "benchmarks/measure/calibration.h"
#include "foundation/result/nearest_name.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

namespace fx::cli {
namespace {

struct BenchArguments
{
    BenchSettings settings;
    std::string wantedHash; ///< hexadecimal
    bool json = false;
};

int refused(const std::string& what)
{
    std::fprintf(stderr, "fx bench: %s\n", what.c_str());
    return kUsage;
}

std::optional<uint64_t> parseHash(std::string_view text)
{
    if (text.starts_with("0x"))
        text.remove_prefix(2);
    uint64_t hash = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return hash;
}

void print(const BenchArguments& arguments, const BenchRow& row)
{
    if (!arguments.json) {
        std::printf("%s\n", toText(row).c_str());
        return;
    }
    nlohmann::json json = toJson(row);
    json["threads"] = arguments.settings.threads;
    json["calibration"] = toJson(calibrate());
    printJsonLine(withMachine(json, readMachine()));
}

int runBench(const BenchEntry& entry, const BenchArguments& arguments)
{
    const auto& variants = entry.variants;
    const std::string& variant = arguments.settings.variant;
    if (!variant.empty() && std::find(variants.begin(), variants.end(), variant) == variants.end())
        return refused("--variant: '" + variant + "' is none of this measurement's" +
                       base::didYouMean(variant, std::vector<std::string>(variants.begin(), variants.end())) +
                       "; see fx bench --help");
    std::optional<uint64_t> wanted;
    if (!arguments.wantedHash.empty()) {
        wanted = parseHash(arguments.wantedHash);
        if (!wanted)
            return refused("--validate-hash: '" + arguments.wantedHash + "' is not a hexadecimal number");
        if (variant.empty() && variants.size() > 1)
            return refused("--validate-hash: say with --variant what the hash is of");
    }
    const base::Result<std::vector<BenchRow>> rows = measureVariants(entry, arguments.settings);
    if (!rows) {
        std::fprintf(stderr, "fx bench: %s\n", rows.status().message().c_str());
        return exitCodeOf(rows.status());
    }
    int exitCode = kSuccess;
    for (const BenchRow& row : *rows) {
        print(arguments, row);
        if (wanted && row.hash != *wanted) {
            std::fprintf(stderr, "fx bench: the hash is not the one that --validate-hash names\n");
            exitCode = kFailed;
        }
    }
    return exitCode;
}

std::string summaryOf(const BenchEntry& entry)
{
    std::string text(entry.summary);
    for (size_t i = 0; i < entry.variants.size(); ++i)
        text += (i > 0 ? ", " : "; variants: ") + std::string(entry.variants[i]);
    return text;
}

void addRowOptions(const BenchEntry& entry, CLI::App& command, int& outExitCode)
{
    auto arguments = std::make_shared<BenchArguments>();
    BenchSettings& settings = arguments->settings;
    command.add_option("--count", settings.count, "Elements (default: what is usual)")
        ->check(CLI::Range(uint64_t(1), uint64_t(1) << 32));
    if (entry.hasThreads)
        command.add_option("--threads", settings.threads, "Threads, 0 for all of the machine (default 1)")
            ->check(CLI::Range(0u, 1024u));
    command.add_option("--steps", settings.steps, "Timed steps (default: about a second's worth)")
        ->check(CLI::Range(1u, 1'000'000u));
    command.add_option("--variant", settings.variant, "One variant alone (default: all)");
    command.add_option("--validate-hash", arguments->wantedHash,
                       "Exit code 1 when what was published has another hash (hexadecimal)");
    if (entry.hasGpu)
        command.add_flag("--gpu", settings.gpu,
                         "Particles are computed on the GPU where it can: path says so");
    if (entry.hasGl)
        command.add_flag("--gl", settings.gl, "A view draws each frame as well; the hash is the picture's");
    command.add_flag("--json", arguments->json, "One object a variant with every number");
    command.callback([arguments, &entry, &outExitCode] { outExitCode = runBench(entry, *arguments); });
}

} // namespace

BenchMeasurement measurementOf(const BenchEntry& entry)
{
    return {std::string(entry.name), summaryOf(entry),
            [&entry](CLI::App& command, int& outExitCode) { addRowOptions(entry, command, outExitCode); }};
}

} // namespace fx::cli
