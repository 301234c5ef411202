/// @file calibrate_command.cpp
/// fx calibrate: what each setting costs and how wrong it is on this machine, for
/// fxView_SetQualityCalibration.

#include "benchmarks/accuracy/accuracy_measure.h"
#include "benchmarks/calibrate/calibrate_levels.h"
#include "benchmarks/report/provenance.h"
#include "benchmarks/scenes/quality_stage.h"
#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/progress.h"
#include "fxsdk/quality/calibration_file.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

namespace fx::cli {
namespace {

struct CalibrateArguments
{
    std::string output;
    std::string size = "320x180";
    std::string clock = "auto";
    uint32_t repetitions = 7;
    std::string technique; ///< empty: all
    bool json = false;
};

int failed(const base::Status& status, int exitCode)
{
    std::fprintf(stderr, "fx calibrate: %s\n", status.message().c_str());
    return exitCode;
}

bool isStep(const MeasuredLevels& measured, size_t point)
{
    const auto& steps = measured.levels.steps;
    return std::any_of(steps.begin(), steps.end(), [&](const quality::ScalabilityLevel& step) {
        return toText(step.knobs) == measured.curve.points[point].setting.name;
    });
}

void printText(const MeasuredCalibration& calibration)
{
    for (const MeasuredLevels& measured : calibration.techniqueLevels) {
        std::printf("%-44s %10s %8s %17s %8s\n", measured.curve.technique.c_str(), "ms", "cost", "range",
                    "error");
        for (size_t k = 0; k < measured.curve.points.size(); ++k) {
            const AccuracyPoint& point = measured.curve.points[k];
            const TimeRatio ratio = timeRatio(measured.curve, k);
            std::printf("%c %-42s %10.3f %8.3f %8.3f-%8.3f %8.4f\n", isStep(measured, k) ? '*' : ' ',
                        point.setting.name.c_str(), nanosecondsPerItem(point) * 1e-6, ratio.best, ratio.low,
                        ratio.high, point.sample.errorMean);
        }
    }
    std::printf("* step of the ladder; ms of a frame, %s clock, on %s\n", clockName(calibration.clock),
                calibration.renderer.c_str());
}

void printJson(const MeasuredCalibration& calibration, const Machine& machine)
{
    for (const MeasuredLevels& measured : calibration.techniqueLevels)
        for (size_t k = 0; k < measured.curve.points.size(); ++k) {
            const AccuracyPoint& point = measured.curve.points[k];
            const TimeRatio ratio = timeRatio(measured.curve, k);
            printJsonLine(withMachine({{"technique", measured.curve.technique},
                                       {"setting", point.setting.name},
                                       {"step", isStep(measured, k)},
                                       {"ms", nanosecondsPerItem(point) * 1e-6},
                                       {"cost", ratio.best},
                                       {"cost_low", ratio.low},
                                       {"cost_high", ratio.high},
                                       {"error", point.sample.errorMean},
                                       {"clock", clockName(calibration.clock)}},
                                      machine));
        }
}

int runCalibrate(const CalibrateArguments& arguments)
{
    CalibrateRules rules;
    base::Status status = readSize(arguments.size, rules.width, rules.height);
    if (status.ok())
        status = readClock(arguments.clock, rules.clock);
    if (status.ok() && (arguments.repetitions < 1 || arguments.repetitions > 1000))
        status = {base::Code::InvalidArgument, "--repeat: 1 to 1000"};
    if (!status)
        return failed(status, kUsage);
    if (!arguments.output.empty())
        if (status = checkTarget(arguments.output); !status)
            return failed(status, kFailed);
    Progress bar("calibrate", 100, !arguments.json);
    rules.repetitions = arguments.repetitions;
    rules.technique = arguments.technique;
    rules.stop = interruptRequested;
    rules.progress = [&](uint64_t done, uint64_t all) { bar.update(done * 100 / all); };
    const auto measured = measureLevels(rules);
    if (!measured)
        return failed(measured.status(), exitCodeOf(measured.status()));
    Machine machine = readMachine();
    machine.glRenderer = measured->renderer;
    if (arguments.json)
        printJson(*measured, machine);
    else
        printText(*measured);
    quality::Calibration calibration{provenance(toText(machine)), {}};
    for (const MeasuredLevels& levels : measured->techniqueLevels)
        calibration.techniqueLevels.push_back(levels.levels);
    const std::string text = calibrationText(calibration);
    if (const auto read = quality::readCalibration(text, "what was measured"); !read)
        return failed(read.status(), kFailed);
    if (!arguments.output.empty())
        if (status = writeFileAtomically(arguments.output, text); !status)
            return failed(status, kFailed);
    return kSuccess;
}

} // namespace

void addCalibrateCommand(CLI::App& app, int& outExitCode)
{
    auto arguments = std::make_shared<CalibrateArguments>();
    CLI::App* command = app.add_subcommand(
        "calibrate", "Measure what each quality setting costs and how wrong it is on this machine");
    command->add_option("-o,--output", arguments->output,
                        "Write the calibration, for fxView_SetQualityCalibration and fx bench budget");
    command->add_option("--size", arguments->size, "Of the frames")->capture_default_str();
    command->add_option("--clock", arguments->clock, "auto, gpu, wall or processor")->capture_default_str();
    command->add_option("--repeat", arguments->repetitions, "Interleaved repetitions")->capture_default_str();
    command->add_option(
        "--technique", arguments->technique,
        "Only this: media, \"media slabs\", \"media volume\", \"light slices\", shimmer or dazzle");
    command->add_flag("--json", arguments->json, "One object a setting");
    command->callback([arguments, &outExitCode] { outExitCode = runCalibrate(*arguments); });
}

} // namespace fx::cli
