/// @file sph.cpp
/// The error of the gas dynamics against time: one knob at a time is turned away from the default.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/accuracy/techniques/explosion.h"
#include "benchmarks/verify/verify_options.h"
#include "simulation/verification/case_run.h"
#include "simulation/verification/gas_cases.h"

#include <algorithm>
#include <cmath>

namespace fx::cli {
namespace {

constexpr uint32_t kBaselineParticles = 24 * 24 * 24;

struct SphSetting
{
    sim::CaseSettings settings;
    bool doublePrecision = false;
};

/// The error below which `share` of the volume lies.
double quantile(const std::vector<sim::DensityError>& ascending, double volume, double share)
{
    double sum = 0;
    for (const sim::DensityError& error : ascending) {
        sum += error.volume;
        if (sum >= share * volume)
            return error.error;
    }
    return ascending.empty() ? 0 : ascending.back().error;
}

void storeErrors(std::vector<sim::DensityError> errors, AccuracySample& out)
{
    double volume = 0;
    double sum = 0;
    double absolute = 0;
    for (sim::DensityError& error : errors) {
        volume += error.volume;
        sum += error.volume * error.error;
        error.error = std::abs(error.error);
        absolute += error.volume * error.error;
    }
    std::stable_sort(errors.begin(), errors.end(),
                     [](const auto& a, const auto& b) { return a.error < b.error; });
    out.errorMean = absolute / volume;
    out.bias = sum / volume;
    out.errorP50 = quantile(errors, volume, 0.5);
    out.errorP99 = quantile(errors, volume, 0.99);
    out.errorMax = errors.empty() ? 0 : errors.back().error;
}

class SphAccuracy final : public AccuracyTechnique
{
public:
    SphAccuracy(const std::string& scene, const AccuracyScale& scale);

    std::string_view scene() const override { return entry_.name; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override;

private:
    template <class F>
    void add(const std::string& name, const std::string& tier, F&& change);

    const sim::GasCaseEntry& entry_;
    std::unique_ptr<base::TaskRunner> tasks_;
    uint32_t particles_;
    std::vector<AccuracySetting> settings_;
    std::vector<SphSetting> sph_;
};

SphAccuracy::SphAccuracy(const std::string& scene, const AccuracyScale& scale)
    : entry_(*sim::findGasCase(scene)),
      tasks_(scale.threads == 1 ? base::makeSerialRunner() : base::makeTbbRunner(scale.threads)),
      particles_(scale.particles > 0 ? scale.particles : kBaselineParticles)
{
    using sim::SphKernel;
    add("default", "default", [](SphSetting&) {});
    add("particles x 1/4", "low", [](SphSetting& s) { s.settings.particles /= 4; });
    add("particles x 1/2", "", [](SphSetting& s) { s.settings.particles /= 2; });
    add("particles x 2", "", [](SphSetting& s) { s.settings.particles *= 2; });
    add("particles x 4", "high", [](SphSetting& s) { s.settings.particles *= 4; });
    for (const double neighbors : {40.0, 80.0, 110.0}) {
        add("neighbors " + std::to_string(int(neighbors)), "",
            [neighbors](SphSetting& s) { s.settings.rules.neighbors = neighbors; });
    }
    for (const char* courant : {"0.1", "0.3", "0.4"})
        add(std::string("courant ") + courant, "",
            [courant](SphSetting& s) { s.settings.rules.courant = std::atof(courant); });
    add("global steps", "", [](SphSetting& s) { s.settings.rules.steps = sim::StepScheme::Global; });
    add("cubic spline", "", [](SphSetting& s) { s.settings.rules.kernel = SphKernel::CubicSpline; });
    add("wendland c4, 110 neighbors", "", [](SphSetting& s) {
        s.settings.rules.kernel = SphKernel::WendlandC4;
        s.settings.rules.neighbors = 110;
    });
    add("quartic", "", [](SphSetting& s) { s.settings.rules.kernel = SphKernel::Quartic; });
    add("double", "", [](SphSetting& s) { s.doublePrecision = true; });
}

template <class F>
void SphAccuracy::add(const std::string& name, const std::string& tier, F&& change)
{
    SphSetting setting;
    setting.settings.particles = particles_;
    change(setting);
    const sim::GasDynamicsDef& rules = setting.settings.rules;
    settings_.push_back({name,
                         tier,
                         {{"particles", setting.settings.particles},
                          {"neighbors", rules.neighbors},
                          {"courant", rules.courant},
                          {"steps_mode", stepsName(rules.steps)},
                          {"kernel", kernelName(rules.kernel)},
                          {"precision", setting.doublePrecision ? "double" : "float"}}});
    sph_.push_back(setting);
}

base::Result<AccuracySample> SphAccuracy::run(size_t index, const std::function<bool()>& stop)
{
    const SphSetting& setting = sph_[index];
    const std::unique_ptr<sim::GasCase> gasCase = sim::makeGasCase(entry_, setting.settings);
    const sim::CaseWatch watch{{}, stop};
    const base::Result<sim::CaseReport> report = setting.doublePrecision
                                                     ? sim::runCase<double>(*gasCase, *tasks_, watch)
                                                     : sim::runCase<float>(*gasCase, *tasks_, watch);
    if (!report)
        return report.status();
    AccuracySample sample;
    storeErrors(report->measures.densityErrors, sample);
    sample.seconds = report->steppingSeconds;
    sample.items = double(report->work.particleSteps);
    sample.work = {
        {"particles", report->particles},
        {"particle_steps", report->work.particleSteps},
        {"pairs", report->work.pairs},
        {"steps", report->work.subSteps},
        {"searches", report->work.searches},
        {"energy_drift", report->energyDrift},
        {"l1_velocity", report->measures.l1Velocity},
        {"l1_pressure", report->measures.l1Pressure},
        {"shock_radius_error", report->measures.shockRadius / report->measures.shockRadiusExact - 1}};
    return sample;
}

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale& scale)
{
    if (scene == "explosion")
        return makeExplosionAccuracy(scale);
    return std::make_unique<SphAccuracy>(scene, scale);
}

} // namespace

AccuracyTechniqueEntry sphAccuracy()
{
    return {"sph",
            "gas dynamics against exact flows, over particles, neighbors, steps and kernels",
            "particle step",
            ShownError::Mean,
            {"sedov", "sod", "noh", "explosion"},
            1,
            true,
            make};
}

} // namespace fx::cli
