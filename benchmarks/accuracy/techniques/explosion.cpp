/// @file explosion.cpp
/// What a reduced speed of sound costs an explosion: the course of the whole cloud, compared with a run of
/// the same particles whose sound is as fast as physics has it.
///
/// Clouds are turbulent, so that single particles soon go their own ways in any two runs. Compared are the
/// cloud's height, radius, speed and temperature, thirty times in two seconds, in units of the largest value
/// that the reference takes.

#include "benchmarks/accuracy/techniques/explosion.h"
#include "benchmarks/scenes/explosion_run.h"
#include "fxsdk/cli/support/interrupt.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace fx::cli {
namespace {

constexpr uint32_t kParticles = 600;
constexpr int kFrames = 2 * kExplosionFrames;
constexpr int kFramesPerLook = 4;

using Course = std::vector<std::array<double, 4>>;

class ExplosionAccuracy final : public AccuracyTechnique
{
public:
    explicit ExplosionAccuracy(const AccuracyScale& scale);

    std::string_view scene() const override { return "explosion"; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override;

private:
    struct Played
    {
        Course course;
        sim::StepCounters counters;
        double seconds = 0;
    };
    void add(const std::string& name, const std::string& tier, float flowMach);
    base::Result<Played> play(const ExplosionSetting& setting, const std::function<bool()>& stop);

    std::unique_ptr<base::TaskRunner> tasks_;
    uint32_t particles_;
    std::vector<AccuracySetting> settings_;
    std::vector<ExplosionSetting> runs_;
    Course reference_; ///< made with the first run
};

ExplosionAccuracy::ExplosionAccuracy(const AccuracyScale& scale)
    : tasks_(scale.threads == 1 ? base::makeSerialRunner() : base::makeTbbRunner(scale.threads)),
      particles_(std::clamp(scale.particles > 0 ? scale.particles : kParticles, 8u, 20'000u))
{
    add("mach-0.3", "default", 0.3f);
    add("mach-0.6", "low", 0.6f);
    add("mach-0.15", "high", 0.15f);
    add("mach-0.075", "", 0.075f);
    add("full-sound", "", 0);
}

void ExplosionAccuracy::add(const std::string& name, const std::string& tier, float flowMach)
{
    settings_.push_back({name, tier, {{"particles", particles_}, {"flow_mach", flowMach}}});
    runs_.push_back({particles_, 0, flowMach});
}

base::Result<ExplosionAccuracy::Played> ExplosionAccuracy::play(const ExplosionSetting& setting,
                                                                const std::function<bool()>& stop)
{
    const auto run = ExplosionRun::create(setting, *tasks_);
    if (!run)
        return run.status();
    Played out;
    for (int frame = 0; frame < kFrames; ++frame) {
        if (stop && stop())
            return interruptedStatus();
        const auto begin = std::chrono::steady_clock::now();
        (*run)->step();
        out.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (frame % kFramesPerLook == kFramesPerLook - 1) {
            const ExplosionState state = (*run)->look();
            out.course.push_back({state.height, state.radius, state.speed, state.temperature});
        }
    }
    out.counters = (*run)->counters();
    return out;
}

/// Differences of two courses in units of the largest value of each quantity in the reference, with sign.
std::vector<double> differences(const Course& course, const Course& reference)
{
    std::vector<double> out;
    for (size_t q = 0; q < 4; ++q) {
        double largest = 0;
        for (const auto& state : reference)
            largest = std::max(largest, std::abs(state[q]));
        for (size_t k = 0; k < reference.size(); ++k)
            out.push_back((course[k][q] - reference[k][q]) / std::max(largest, 1e-30));
    }
    return out;
}

base::Result<AccuracySample> ExplosionAccuracy::run(size_t index, const std::function<bool()>& stop)
{
    if (reference_.empty()) {
        const base::Result<Played> reference = play({particles_, 0, 0}, stop);
        if (!reference)
            return reference.status();
        reference_ = reference->course;
    }
    const base::Result<Played> played = play(runs_[index], stop);
    if (!played)
        return played.status();
    std::vector<double> errors = differences(played->course, reference_);
    AccuracySample sample;
    for (double& error : errors) {
        sample.bias += error / double(errors.size());
        error = std::abs(error);
        sample.errorMean += error / double(errors.size());
    }
    std::sort(errors.begin(), errors.end());
    sample.errorP50 = errors[errors.size() / 2];
    sample.errorP99 = errors[(errors.size() - 1) * 99 / 100];
    sample.errorMax = errors.back();
    sample.seconds = played->seconds;
    sample.items = double(played->counters.particleSteps);
    sample.work = {{"particles", particles_},
                   {"particle_steps", played->counters.particleSteps},
                   {"steps", played->counters.subSteps},
                   {"simulated_per_second", kFrames / double(kExplosionFrames) / played->seconds}};
    return sample;
}

} // namespace

std::unique_ptr<AccuracyTechnique> makeExplosionAccuracy(const AccuracyScale& scale)
{
    return std::make_unique<ExplosionAccuracy>(scale);
}

} // namespace fx::cli
