/// @file accuracy_command.cpp
/// fx accuracy: what exactness costs in time.

#include "benchmarks/accuracy/accuracy_measure.h"
#include "benchmarks/measure/calibration.h"
#include "benchmarks/measure/option_text.h"
#include "benchmarks/report/provenance.h"
#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/progress.h"

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
    uint32_t frames = 0;
    uint32_t cases = 0;
    int width = 0, height = 0;
    double bound = 0.0;
    std::string csv;
    std::string svg;
    std::string html;
    bool noCallgrind = false;
    bool countWork = false;
    bool json = false;
};

int failed(const base::Status& status, int exitCode)
{
    std::fprintf(stderr, "fx accuracy: %s\n", status.message().c_str());
    return exitCode;
}

base::Status checkArguments(const AccuracyArguments& arguments, const std::vector<AccuracyTask>& tasks)
{
    const auto refused = [](const char* text) { return base::Status(base::Code::InvalidArgument, text); };
    if (arguments.repetitions < 1 || arguments.repetitions > 1000 || arguments.threads < 1)
        return refused("--repeat: 1 to 1000; --threads: 1 or more");
    if (!arguments.particles.empty() && particleCount(arguments.particles) < 2048)
        return refused("--particles: 2048 to 2^28, as 13824 or 24^3");
    bool isScalable = false, hasFrames = false, hasCases = false;
    for (const AccuracyTask& task : tasks) {
        isScalable = isScalable || task.technique->isScalable;
        hasFrames = hasFrames || task.technique->hasFrames;
        hasCases = hasCases || task.technique->hasCases;
    }
    if (!hasCases && arguments.cases > 0)
        return refused("--cases: this technique has no random cases; impostors has");
    if (!hasFrames && (arguments.frames > 0 || arguments.width > 0 || arguments.bound > 0.0))
        return refused("--frames, --size and --bound: this technique has no frames");
    if (!isScalable && (!arguments.particles.empty() || arguments.threads > 1))
        return refused(
            "--particles and --threads: this technique has its own scenes, and measures one thread");
    return {};
}

base::Result<std::vector<AccuracyCurve>> measureAll(const AccuracyArguments& arguments,
                                                    const std::vector<AccuracyTask>& tasks)
{
    std::vector<AccuracyCurve> curves;
    for (const AccuracyTask& task : tasks) {
        Progress bar(std::string(task.technique->name) + " " + task.scene + " run",
                     uint64_t(arguments.repetitions) * 20, !arguments.json);
        MeasureRules rules;
        rules.scale = {particleCount(arguments.particles),
                       arguments.threads,
                       arguments.frames,
                       arguments.width,
                       arguments.height,
                       arguments.bound,
                       arguments.cases};
        rules.repetitions = arguments.repetitions;
        rules.useCallgrind = !arguments.noCallgrind;
        rules.stop = interruptRequested;
        rules.progress = [&](uint64_t done, uint64_t all) {
            bar.update(done * uint64_t(arguments.repetitions) * 20 / all);
        };
        base::Result<AccuracyCurve> curve = measureAccuracy(task, rules);
        if (!curve)
            return curve.status();
        curves.push_back(std::move(*curve));
        if (interruptRequested())
            return interruptedStatus();
    }
    return curves;
}

base::Status writeReports(const AccuracyArguments& arguments, const std::vector<AccuracyCurve>& curves,
                          const std::string& origin)
{
    base::Status status;
    if (!arguments.csv.empty())
        status = writeFileAtomically(arguments.csv, curvesCsv(curves, origin));
    if (status.ok() && !arguments.svg.empty())
        status = writeFileAtomically(arguments.svg, curvesSvg(curves, origin));
    if (status.ok() && !arguments.html.empty())
        status = writeFileAtomically(arguments.html, curvesHtml(curves, origin));
    return status;
}

void printReport(const AccuracyArguments& arguments, const std::vector<AccuracyCurve>& curves,
                 const Machine& machine)
{
    if (!arguments.json) {
        for (const AccuracyCurve& curve : curves)
            std::printf("%s\n", curveTable(curve).c_str());
        std::printf("%s, %u threads, %u repetitions\n", provenance(toText(machine)).c_str(),
                    curves.back().threads, arguments.repetitions);
        return;
    }
    const nlohmann::json calibration = toJson(calibrate());
    for (const AccuracyCurve& curve : curves)
        for (nlohmann::json line : curveJson(curve)) {
            line["calibration"] = calibration;
            printJsonLine(withMachine(line, machine));
        }
}

/// What settings promise and controls break.
bool isAsPromised(const std::vector<AccuracyCurve>& curves)
{
    bool holds = true;
    for (const AccuracyCurve& curve : curves)
        for (const AccuracyPoint& point : curve.points) {
            if (!point.sample.isAsPromised)
                std::fprintf(stderr, "fx accuracy: %s on %s: %s is not as promised: %s\n",
                             curve.technique.c_str(), curve.scene.c_str(), point.setting.name.c_str(),
                             point.sample.note.c_str());
            holds = holds && point.sample.isAsPromised;
        }
    return holds;
}

int runAccuracy(const AccuracyArguments& arguments)
{
    const base::Result<std::vector<AccuracyTask>> tasks = accuracyTasks(arguments.technique, arguments.scene);
    if (!tasks)
        return failed(tasks.status(), kUsage);
    if (base::Status status = checkArguments(arguments, *tasks); !status)
        return failed(status, kUsage);
    if (arguments.countWork)
        return countWork(tasks->front()) ? kSuccess : kFailed;
    for (const std::string& file : {arguments.csv, arguments.svg, arguments.html})
        if (base::Status status = file.empty() ? base::Status() : checkTarget(file); !status)
            return failed(status, kFailed);
    const base::Result<std::vector<AccuracyCurve>> curves = measureAll(arguments, *tasks);
    if (!curves)
        return failed(curves.status(), exitCodeOf(curves.status()));
    const Machine machine = readMachine();
    printReport(arguments, *curves, machine); // first: what was measured is not lost with a file
    if (base::Status status = writeReports(arguments, *curves, provenance(toText(machine))); !status)
        return failed(status, kFailed);
    return isAsPromised(*curves) ? kSuccess : kFailed;
}

std::string techniqueHelp()
{
    std::string text;
    for (const AccuracyTechniqueEntry& entry : accuracyTechniques())
        text += std::string(entry.name) + ": " + std::string(entry.summary) + "; ";
    return text + "all";
}

void addFrameSize(CLI::App& command, AccuracyArguments& arguments)
{
    command.add_option_function<std::string>(
        "--size",
        [&arguments](const std::string& text) {
            char rest = 0;
            if (std::sscanf(text.c_str(), "%dx%d%c", &arguments.width, &arguments.height, &rest) != 2 ||
                std::min(arguments.width, arguments.height) < 8 ||
                std::max(arguments.width, arguments.height) > 4096)
                throw CLI::ValidationError("--size", "'" + text + "' is not WIDTHxHEIGHT, each 8 to 4096");
        },
        "[pixel] flights: of the pictures; default 96x54");
}

} // namespace

void addAccuracyCommand(CLI::App& app, int& outExitCode)
{
    auto arguments = std::make_shared<AccuracyArguments>();
    CLI::App* command =
        app.add_subcommand("accuracy", "Error against time of a technique, setting by setting");
    command->add_option("TECHNIQUE", arguments->technique, techniqueHelp())->required();
    command->add_option("--scene", arguments->scene, "One scene of the technique, such as tau-10 or sedov");
    command->add_option("--particles", arguments->particles, "sph: size of the baseline, as 13824 or 24^3");
    command->add_option("--repeat", arguments->repetitions, "Interleaved repetitions")->capture_default_str();
    command->add_option("--threads", arguments->threads, "sph: threads of each run")->capture_default_str();
    command->add_option("--frames", arguments->frames, "flights: frames, at most those of the whole flight")
        ->check(CLI::Range(3, 100'000));
    command
        ->add_option("--cases", arguments->cases, "impostors: random cases of the scene cases; default 100")
        ->check(CLI::Range(1, 1'000'000));
    addFrameSize(*command, *arguments);
    command
        ->add_option("--bound", arguments->bound,
                     "flights: change from frame to frame, in units of the reference's; default 1.5")
        ->check(CLI::Range(1.01, 100.0));
    command->add_option("--csv", arguments->csv, "Write the curves as a table");
    command->add_option("--svg", arguments->svg, "Draw the curves: error against time on logarithmic axes");
    command->add_option("--html", arguments->html, "Write a page with plots and tables");
    command->add_flag("--no-callgrind", arguments->noCallgrind,
                      "Leave instructions out where the system itself does not count them");
    command->add_flag("--count-work", arguments->countWork)->group(""); // what callgrind is given to run
    command->add_flag("--json", arguments->json, "One object a setting");
    command->callback([arguments, &outExitCode] { outExitCode = runAccuracy(*arguments); });
}

} // namespace fx::cli
