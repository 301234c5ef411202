/// @file stability_command.cpp
/// fx stability: hard cases swept at full size, with maps of the errors.

#include "benchmarks/report/provenance.h"
#include "benchmarks/stability/stability_picture.h"
#include "benchmarks/stability/stability_run.h"
#include "foundation/result/nearest_name.h"
#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/machine.h"
#include "fxsdk/cli/support/progress.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {
namespace {

struct StabilityArguments
{
    std::vector<std::string> rows;
    std::string folder;
    bool isQuick = false;
    bool showsSweeps = false;
};

int failed(const base::Status& status, int exitCode)
{
    std::fprintf(stderr, "fx stability: %s\n", status.message().c_str());
    return exitCode;
}

/// Rows whose id is named or begins with what is named: R-03, DZ. All when nothing is.
base::Result<std::vector<StabilityRow>> chosenRows(const std::vector<std::string>& names)
{
    if (names.empty())
        return stabilityRows();
    std::vector<bool> isChosen(stabilityRows().size(), false);
    for (const std::string& name : names) {
        bool isKnown = false;
        for (size_t i = 0; i < isChosen.size(); ++i) {
            const std::string_view id = stabilityRows()[i].id;
            if (id == name || id.substr(0, id.find('-')) == name)
                isChosen[i] = isKnown = true;
        }
        if (!isKnown) {
            std::string list;
            std::vector<std::string> known;
            for (const StabilityRow& row : stabilityRows()) {
                known.emplace_back(row.id);
                list += " " + known.back();
            }
            return base::Status(base::Code::InvalidArgument,
                                "there is no row " + name + base::didYouMean(name, known) + "; there are" +
                                    list + ", and all of a kind as R, B, L, LS, H, DZ");
        }
    }
    std::vector<StabilityRow> rows;
    for (size_t i = 0; i < isChosen.size(); ++i)
        if (isChosen[i])
            rows.push_back(stabilityRows()[i]);
    return rows;
}

base::Status writeMaps(const std::filesystem::path& folder, const StabilityResult& result,
                       const std::string& origin)
{
    for (const StabilityMap& map : result.maps) {
        const std::string stem = fileStem(result, map);
        if (base::Status status = writeFileAtomically(folder / (stem + ".csv"), mapCsv(result, map, origin));
            !status)
            return status;
        const base::Result<std::vector<std::byte>> png = image::writePng(mapPicture(result, map));
        if (!png)
            return png.status();
        const std::string_view bytes(reinterpret_cast<const char*>(png->data()), png->size());
        if (base::Status status = writeFileAtomically(folder / (stem + ".png"), bytes); !status)
            return status;
    }
    return {};
}

int runRows(const StabilityArguments& arguments, const std::vector<StabilityRow>& rows)
{
    const std::string origin = provenance(toText(readMachine()));
    size_t broken = 0;
    for (const StabilityRow& row : rows) {
        base::Result<StabilityResult> result = base::Status();
        {
            Progress bar(std::string(row.id) + " place", 1000, true);
            const RunWatch watch{interruptRequested,
                                 [&](uint64_t done, uint64_t all) { bar.update(done * 1000 / all); }};
            result = runStability(row, arguments.isQuick, watch);
        }
        if (!result)
            return failed(result.status(), exitCodeOf(result.status()));
        if (base::Status status = writeMaps(arguments.folder, *result, origin); !status)
            return failed(status, kFailed);
        std::printf("%s\n%s", toText(*result).c_str(),
                    arguments.showsSweeps ? sweepsText(*result).c_str() : "");
        std::fflush(stdout);
        broken += result->isAsItMust() ? 0 : 1;
    }
    std::printf("%zu of %zu rows as they must be; %s\n", rows.size() - broken, rows.size(), origin.c_str());
    return broken == 0 ? kSuccess : kFailed;
}

int runStabilityCommand(const StabilityArguments& arguments)
{
    const base::Result<std::vector<StabilityRow>> rows = chosenRows(arguments.rows);
    if (!rows)
        return failed(rows.status(), kUsage);
    std::error_code error;
    std::filesystem::create_directories(arguments.folder, error);
    if (error)
        return failed({base::Code::Io, arguments.folder + ": " + error.message()}, kFailed);
    return runRows(arguments, *rows);
}

} // namespace

void addStabilityCommand(CLI::App& app, int& outExitCode)
{
    auto arguments = std::make_shared<StabilityArguments>();
    CLI::App* command =
        app.add_subcommand("stability", "Hard numerical cases, swept: the largest error of each, and maps");
    command->add_option("ROW", arguments->rows,
                        "Rows such as R-03, or all of a kind: R B L LS H DZ; none: all");
    command->add_option("-o,--output", arguments->folder, "Folder for the maps, CSV and PNG")->required();
    command->add_flag("--quick", arguments->isQuick, "A fifth of the steps on every axis");
    command->add_flag("--sweeps", arguments->showsSweeps, "A line for each sweep of a row too");
    command->callback([arguments, &outExitCode] { outExitCode = runStabilityCommand(*arguments); });
}

} // namespace fx::cli
