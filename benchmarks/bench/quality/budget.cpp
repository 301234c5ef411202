// fx bench budget: real frames whose load jumps, under a budget, with the controller and without.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/quality/budget_check.h"
#include "benchmarks/scenes/quality_stage.h"
#include "fxsdk/assets/read_file.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/progress.h"
#include "fxsdk/quality/calibration_file.h"
#include "fxsdk/quality/scalability_levels.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <vector>

namespace fx::cli {
namespace {

constexpr std::array<size_t, 3> kColumns = {2, 5, 16}; ///< smoke columns a site: loads 1, 2.5 and 8
constexpr double kApart = 200.0;                       ///< [m] between sites: none is seen from another
constexpr double kBeside = 0.3;                        ///< [m] between columns of a site
constexpr double kStart = 4.0;                         ///< [s] until the smoke has risen
constexpr int kBurst = 10;                             ///< [frame] of a load that is soon gone
constexpr int kWarmUp = 20;                            ///< [frame]
constexpr int kCompareEvery = 10;                      ///< [frame] a picture is read back

struct BenchBudgetArguments
{
    std::string size = "256x144"; ///< [pixel]
    std::string clock = "auto";   ///< gpu, wall, processor or auto
    std::string calibration;      ///< file of fx calibrate; empty: the built-in one
    double budget = 0;            ///< [ms] 0: 1.5 times a frame of the least load at full quality
    int frames = 120;             ///< of each section of equal load
    bool json = false;
    bool check = false; ///< fail when the controller misses its bounds, or when the load is no trial
};

/// A way to choose quality, and what it came to.
struct Contestant
{
    const char* name;
    std::vector<double> milliseconds;
    int over = 0, switches = 0, longestOver = 0, runOver = 0;
    double estimatedError = 0, measuredError = 0;
    int compared = 0;
    quality::Choice choice{};
};

class BudgetBench
{
public:
    BudgetBench(const BenchBudgetArguments& arguments, quality::Calibration calibration)
        : arguments_(arguments), techniqueLevels_(levelsFor(calibration, render::Composition::Sorted)),
          calibration_(std::move(calibration))
    {}

    base::Status run(int width, int height, std::optional<StageClock> clock);
    void print() const;
    std::string fault() const;

private:
    base::Status start(int width, int height, std::optional<StageClock> clock);
    base::Status findBudget();
    base::Status section(size_t site, int frames);
    base::Status frame();
    base::Status drawAs(Contestant& contestant);
    void decide(Contestant& contestant);
    void count(Contestant& contestant);
    void compareTo(Contestant& contestant);

    const BenchBudgetArguments& arguments_;
    std::vector<quality::ScalabilityLevels> techniqueLevels_;
    quality::Calibration calibration_;
    scene_file::SceneFile file_;
    std::unique_ptr<QualityStage> stage_;
    std::unique_ptr<Progress> bar_;
    StageClock clock_ = StageClock::Wall;
    double budget_ = 0; ///< [ms]
    int done_ = 0;      ///< frames
    int saturated_ = 0; ///< frames for which even the lowest settings were expected to be too slow
    std::vector<float> fixedPicture_;
    Contestant fixed_{"fixed", {}}, naive_{"naive", {}}, controller_{"controller", {}};
};

base::Status BudgetBench::start(int width, int height, std::optional<StageClock> clock)
{
    auto scene = sceneOfPreset("library:smoke-column");
    if (!scene.ok())
        return scene.status();
    file_ = std::move(*scene);
    file_.view.dazzle.enabled = false;
    if (base::Status status = frameEffect(file_, base::toTicks(kStart), {}); !status)
        return status;
    const scene_file::SceneInstance column = file_.instances.front();
    file_.instances.clear();
    for (size_t site = 0; site < kColumns.size(); ++site)
        for (size_t k = 0; k < kColumns[site]; ++k) {
            file_.instances.push_back(column);
            file_.instances.back().position.x += kApart * double(site) + kBeside * double(k % 4);
            file_.instances.back().position.z -= kBeside * double(k / 4);
        }
    auto stage = QualityStage::create(file_, width, height);
    if (!stage.ok())
        return stage.status();
    stage_ = std::move(*stage);
    clock_ = clock.value_or(stage_->bestClock());
    stage_->view().quality.setCalibration(calibration_);
    return stage_->simulate(base::toTicks(kStart));
}

/// Full quality at the least load, for a while.
base::Status BudgetBench::findBudget()
{
    if (base::Status status = stage_->look(file_.camera); !status)
        return status;
    if (base::Status status = stage_->setBudget(0.0, clock_); !status)
        return status;
    stage_->view().quality.force(quality::Knobs{});
    std::vector<double> times;
    for (int k = 0; k < kWarmUp; ++k) {
        if (base::Status status = stage_->draw(); !status)
            return status;
        times.push_back(stage_->times().total());
    }
    std::nth_element(times.begin(), times.begin() + kWarmUp / 2, times.end());
    budget_ = arguments_.budget > 0.0 ? arguments_.budget : 1.5 * times[kWarmUp / 2];
    if (!(budget_ > 0.0))
        return {base::Code::GlFailed, "frames could not be timed; try --clock wall"};
    naive_.choice = fixed_.choice = controller_.choice = quality::highest(techniqueLevels_);
    return stage_->setBudget(budget_, clock_);
}

base::Status BudgetBench::section(size_t site, int frames)
{
    scene_file::CameraPath camera = file_.camera;
    camera.position.x += kApart * double(site);
    camera.target.x += kApart * double(site);
    if (base::Status status = stage_->look(camera); !status)
        return status;
    for (int k = 0; k < frames; ++k) {
        if (interruptRequested())
            return interruptedStatus();
        if (base::Status status = frame(); !status)
            return status;
        bar_->update(uint64_t(++done_));
    }
    return {};
}

base::Status BudgetBench::frame()
{
    if (base::Status status = stage_->simulate(base::toTicks(kStart + (done_ + 1) / 60.0)); !status)
        return status;
    for (Contestant* contestant : {&fixed_, &naive_, &controller_})
        if (base::Status status = drawAs(*contestant); !status)
            return status;
    saturated_ += stage_->view().quality.controller()->isSaturated() ? 1 : 0;
    return {};
}

base::Status BudgetBench::drawAs(Contestant& contestant)
{
    const quality::Choice before = contestant.choice;
    decide(contestant);
    if (base::Status status = stage_->draw(); !status)
        return status;
    if (&contestant == &controller_)
        contestant.choice = stage_->view().quality.choice();
    contestant.switches += contestant.choice != before ? 1 : 0;
    count(contestant);
    if (done_ % kCompareEvery == 0)
        compareTo(contestant);
    return {};
}

/// The naive one goes one step down or up for all, by the time of its last frame.
void BudgetBench::decide(Contestant& contestant)
{
    quality::ViewQuality& quality = stage_->view().quality;
    if (&contestant == &controller_) {
        quality.force(std::nullopt);
        return;
    }
    quality::Knobs knobs;
    const double last = contestant.milliseconds.empty() ? budget_ : contestant.milliseconds.back();
    for (size_t i = 0; i < techniqueLevels_.size(); ++i) {
        uint8_t& step = contestant.choice[i];
        if (&contestant == &naive_ && last > budget_ && step > 0)
            --step;
        else if (&contestant == &naive_ && budget_ > 1.15 * last &&
                 step + 1u < techniqueLevels_[i].steps.size())
            ++step;
        knobs = merged(knobs, techniqueLevels_[i].steps[step].knobs);
    }
    quality.force(knobs);
}

void BudgetBench::count(Contestant& contestant)
{
    const double milliseconds = stage_->times().total();
    contestant.milliseconds.push_back(milliseconds);
    const bool over = milliseconds > budget_;
    contestant.over += over ? 1 : 0;
    contestant.runOver = over ? contestant.runOver + 1 : 0;
    contestant.longestOver = std::max(contestant.longestOver, contestant.runOver);
    const auto weights = stage_->view().quality.weights();
    for (size_t i = 0; i < techniqueLevels_.size(); ++i)
        contestant.estimatedError += weights[i] * techniqueLevels_[i].steps[contestant.choice[i]].error;
}

void BudgetBench::compareTo(Contestant& contestant)
{
    const std::vector<float> picture = stage_->picture();
    if (&contestant == &fixed_)
        fixedPicture_ = picture;
    const PictureDifference found = compare(picture, fixedPicture_, stage_->background());
    contestant.measuredError += found.light > 0.0 ? found.difference / found.light : 0.0;
    ++contestant.compared;
}

base::Status BudgetBench::run(int width, int height, std::optional<StageClock> clock)
{
    if (base::Status status = start(width, height, clock); !status)
        return status;
    if (base::Status status = findBudget(); !status)
        return status;
    const int n = arguments_.frames;
    const std::pair<size_t, int> sections[] = {{0, n}, {1, n}, {0, n}, {2, n}, {0, n}, {2, kBurst}, {0, n}};
    bar_ = std::make_unique<Progress>("frame", uint64_t(6 * n + kBurst), !arguments_.json);
    for (const auto& [site, frames] : sections)
        if (base::Status status = section(site, frames); !status)
            return status;
    bar_.reset();
    return {};
}

void BudgetBench::print() const
{
    Machine machine = readMachine();
    machine.glRenderer = stage_->rendererName();
    if (!arguments_.json)
        std::printf("budget %.2f ms (%s clock), load 1, 2.5, 1, 8, 1, 8 for %d frames, 1; %d frames; %s\n"
                    "%-12s %8s %13s %10s %9s %11s %16s %15s\n",
                    budget_, clockName(clock_), kBurst, done_, toText(machine).c_str(), "", "over",
                    "longest over", "switches", "median ms", "largest ms", "estimated error",
                    "measured error");
    for (const Contestant* c : {&controller_, &fixed_, &naive_}) {
        std::vector<double> sorted = c->milliseconds;
        std::sort(sorted.begin(), sorted.end());
        const double frames = double(done_);
        const double measured = c->measuredError / std::max(1, c->compared);
        if (arguments_.json)
            printJsonLine(withMachine({{"benchmark", "budget"},
                                       {"quality", c->name},
                                       {"clock", clockName(clock_)},
                                       {"budget_ms", budget_},
                                       {"frames", done_},
                                       {"over_share", c->over / frames},
                                       {"longest_over_frames", c->longestOver},
                                       {"switch_share", c->switches / frames},
                                       {"median_ms", sorted[sorted.size() / 2]},
                                       {"largest_ms", sorted.back()},
                                       {"estimated_error", c->estimatedError / frames},
                                       {"measured_error", measured},
                                       {"saturated_frames", saturated_}},
                                      machine));
        else
            std::printf("%-12s %7.2f%% %13d %9.2f%% %9.2f %11.2f %16.4f %15.4f\n", c->name,
                        100.0 * c->over / frames, c->longestOver, 100.0 * c->switches / frames,
                        sorted[sorted.size() / 2], sorted.back(), c->estimatedError / frames, measured);
    }
    if (!arguments_.json && saturated_ > 0)
        std::printf("in %d frames even the lowest settings were expected to exceed the budget\n", saturated_);
}

std::string BudgetBench::fault() const
{
    const auto shares = [&](const Contestant& c) {
        return BudgetShares{double(c.over) / double(done_), double(c.switches) / double(done_)};
    };
    return findBudgetFault(shares(controller_), shares(fixed_), shares(naive_));
}

base::Result<quality::Calibration> calibrationOf(const BenchBudgetArguments& arguments)
{
    if (arguments.calibration.empty())
        return quality::builtInCalibration();
    const auto text = asset::readFile(arguments.calibration, quality::kCalibrationBytes);
    if (!text)
        return text.status();
    return quality::readCalibration(*text, arguments.calibration);
}

int failed(const base::Status& status, int exitCode)
{
    std::fprintf(stderr, "fx bench budget: %s\n", status.message().c_str());
    return exitCode;
}

/// Prints one line for each way to choose quality: the controller, fixed quality, and a naive controller.
/// All draw the same moments, in turn. @return exit code
int runBenchBudget(const BenchBudgetArguments& arguments)
{
    int width = 0, height = 0;
    std::optional<StageClock> clock;
    base::Status status = readSize(arguments.size, width, height);
    if (status.ok())
        status = readClock(arguments.clock, clock);
    if (status.ok() && (arguments.frames < 1 || arguments.frames > 100'000 || !(arguments.budget >= 0.0)))
        status = {base::Code::InvalidArgument, "--frames: 1 to 100000; --budget: 0 or more milliseconds"};
    if (!status)
        return failed(status, kUsage);
    auto calibration = calibrationOf(arguments);
    if (!calibration)
        return failed(calibration.status(), kFailed);
    BudgetBench bench(arguments, std::move(*calibration));
    if (status = bench.run(width, height, clock); !status)
        return failed(status, exitCodeOf(status));
    bench.print();
    const std::string fault = arguments.check ? bench.fault() : "";
    if (fault.empty())
        return kSuccess;
    std::fprintf(stderr, "fx bench budget: %s\n", fault.c_str());
    return kFailed;
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto arguments = std::make_shared<BenchBudgetArguments>();
    command.add_option("--size", arguments->size, "Of the frames")->capture_default_str();
    command.add_option("--clock", arguments->clock, "auto, gpu, wall or processor")->capture_default_str();
    command.add_option("--calibration", arguments->calibration, "A file of fx calibrate");
    command.add_option("--budget", arguments->budget,
                       "[ms] default: 1.5 times a frame of the least load at full quality");
    command.add_option("--frames", arguments->frames, "Frames of equal load")->capture_default_str();
    command.add_flag("--check", arguments->check,
                     "Fail when the controller is over budget in more than 5 % of the frames or changes "
                     "settings in more than 3 %, or when the others keep that");
    command.add_flag("--json", arguments->json, "One object a way to choose quality");
    command.callback([arguments, &outExitCode] { outExitCode = runBenchBudget(*arguments); });
}

} // namespace

BenchMeasurement budgetBench()
{
    return {"budget", "Frames whose load jumps, with quality by budget and without", addOptions};
}

} // namespace fx::cli
