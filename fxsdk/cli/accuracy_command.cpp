/// @file accuracy_command.cpp
/// fx accuracy: what exactness costs in time.

#include "fxsdk/cli/accuracy_curve.h"
#include "fxsdk/cli/atomic_file.h"
#include "fxsdk/cli/calibration.h"
#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/exit_code.h"
#include "fxsdk/cli/instruction_counter.h"
#include "fxsdk/cli/interrupt.h"
#include "fxsdk/cli/json_line.h"
#include "fxsdk/cli/progress.h"
#include "fxsdk/cli/verify_options.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

struct AccuracyArguments
{
    std::string technique;
    std::string scene;
    std::string particles;
    uint32_t repetitions = 7;
    uint32_t threads = 1;
    std::string csv;
    std::string svg;
    bool json = false;
};

int failed(const base::Status& status, int exitCode)
{
    std::fprintf(stderr, "fx accuracy: %s\n", status.message().c_str());
    return exitCode;
}

base::Result<std::unique_ptr<AccuracyTechnique>> makeTechnique(const AccuracyArguments& arguments)
{
    std::vector<std::string> names;
    for (const AccuracyTechniqueEntry& entry : accuracyTechniques()) {
        names.emplace_back(entry.name);
        if (entry.name != arguments.technique)
            continue;
        const std::string scene = arguments.scene.empty() ? entry.scenes.front() : arguments.scene;
        if (std::find(entry.scenes.begin(), entry.scenes.end(), scene) == entry.scenes.end())
            return unknownName("scene", scene, entry.scenes);
        const AccuracyScale scale{particleCount(arguments.particles), arguments.threads};
        if (!arguments.particles.empty() && scale.particles < 2048)
            return base::Status(base::Code::InvalidArgument, "--particles: 2048 to 2^28, as 13824 or 24^3");
        return entry.make(scene, scale);
    }
    return unknownName("technique", arguments.technique, names);
}

base::Result<AccuracyCurve> measure(const AccuracyArguments& arguments, AccuracyTechnique& technique)
{
    AccuracyCurve curve{arguments.technique, std::string(technique.scene()), {}};
    for (const AccuracySetting& setting : technique.settings())
        curve.points.push_back({setting, {}, {}, {}});
    InstructionCounter counter;
    Progress progress("run", uint64_t(arguments.repetitions) * curve.points.size(), !arguments.json);
    uint64_t done = 0;
    for (uint32_t round = 0; round < arguments.repetitions; ++round) {
        for (size_t k = 0; k < curve.points.size(); ++k) {
            counter.start();
            const base::Result<AccuracySample> sample = technique.run(k, interruptRequested);
            const double instructions = counter.stop();
            if (!sample)
                return sample.status();
            if (round == 0)
                curve.points[k].sample = *sample;
            curve.points[k].seconds.push_back(sample->seconds);
            curve.points[k].instructions.push_back(instructions);
            progress.update(++done);
        }
    }
    return curve;
}

int runAccuracy(const AccuracyArguments& arguments)
{
    if (arguments.repetitions < 1 || arguments.repetitions > 1000 || arguments.threads < 1)
        return failed({base::Code::InvalidArgument, "--repeat: 1 to 1000; --threads: 1 or more"}, kUsage);
    const auto technique = makeTechnique(arguments);
    if (!technique)
        return failed(technique.status(), kUsage);
    const base::Result<AccuracyCurve> curve = measure(arguments, **technique);
    if (!curve)
        return failed(curve.status(), exitCodeOf(curve.status()));
    const Machine machine = readMachine();
    if (!arguments.csv.empty()) {
        if (base::Status status = writeFileAtomically(arguments.csv, curveCsv(*curve, toText(machine)));
            !status)
            return failed(status, kFailed);
    }
    if (!arguments.svg.empty()) {
        if (base::Status status = writeFileAtomically(arguments.svg, curveSvg(*curve, toText(machine)));
            !status)
            return failed(status, kFailed);
    }
    if (!arguments.json) {
        std::printf("%s\non %s, %u threads, %u repetitions\n", curveTable(*curve).c_str(),
                    toText(machine).c_str(), arguments.threads, arguments.repetitions);
        return kSuccess;
    }
    const nlohmann::json calibration = toJson(calibrate());
    for (nlohmann::json line : curveJson(*curve)) {
        line["threads"] = arguments.threads;
        line["calibration"] = calibration;
        printJsonLine(withMachine(line, machine));
    }
    return kSuccess;
}

} // namespace

void addAccuracyCommand(CLI::App& app, int& outExitCode)
{
    auto arguments = std::make_shared<AccuracyArguments>();
    CLI::App* command =
        app.add_subcommand("accuracy", "Error against time of a technique, setting by setting");
    command->add_option("TECHNIQUE", arguments->technique, "sph")->required();
    command->add_option("--scene", arguments->scene, "What to compute: of sph sedov, sod, noh or explosion");
    command->add_option("--particles", arguments->particles, "Size of the baseline, as 13824 or 24^3");
    command->add_option("--repeat", arguments->repetitions, "Interleaved repetitions")->capture_default_str();
    command->add_option("--threads", arguments->threads, "Threads of each run")->capture_default_str();
    command->add_option("--csv", arguments->csv, "Write the curve as a table");
    command->add_option("--svg", arguments->svg, "Draw the curve: error against time on logarithmic axes");
    command->add_flag("--json", arguments->json, "One object a setting");
    command->callback([arguments, &outExitCode] { outExitCode = runAccuracy(*arguments); });
}

} // namespace fx::cli
