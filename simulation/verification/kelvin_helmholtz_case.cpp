/// @file kelvin_helmholtz_case.cpp
/// A stream of density 2 and speed 1/2 in gas of density 1 that moves the other way, all at pressure 2.5, in
/// a periodic unit square and a slab of it. A slight wave across both boundaries grows.
///
/// The lattice is the same in both gases and the masses differ, so that the gases are equally resolved.

#include "foundation/math/elementary.h"
#include "simulation/verification/case_base.h"
#include "simulation/verification/gas_cases.h"
#include "simulation/verification/lattice.h"
#include "simulation/verification/shear_layer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::sim {
namespace {

constexpr double kPressure = 2.5;
constexpr double kDense = 2;
constexpr double kThin = 1;
constexpr double kSpeed = 0.5;
constexpr double kWaves = 2; ///< in the length of the box
constexpr double kSeed = 0.1;
constexpr double kSeedWidth = 0.05 / std::numbers::sqrt2;
constexpr double kTime = 0.3;
constexpr uint32_t kSamples = 60;
/// [s] between which growth is measured: after the sound of the start has passed, and before smaller waves,
/// which the particles' own disorder seeds and which grow faster, have made the sharp boundary a broad one.
constexpr double kFrom = 0.1;
constexpr double kTo = 0.25;

struct Amplitude
{
    double time;
    double value;
};

class KelvinHelmholtzCase final : public CaseBase
{
public:
    explicit KelvinHelmholtzCase(const CaseSettings& settings);
    void look(double time, std::span<const CaseParticle> particles) override;
    ProfilePoint seen(const CaseParticle& particle) const override;
    CaseMeasures measure(std::span<const CaseParticle> particles) const override;

private:
    double growthRate() const;

    uint32_t side_;
    std::vector<Amplitude> amplitudes_;
};

double gaussian(double x)
{
    return base::naturalExp(-0.5 * x * x);
}

/// Distance of a height from the nearer boundary at 1/4 and 3/4 [m].
double toBoundary(double y)
{
    return std::abs(std::abs(y - 0.5) - 0.25);
}

KelvinHelmholtzCase::KelvinHelmholtzCase(const CaseSettings& settings)
    : CaseBase(settings, 5.0 / 3.0, kTime), side_(4)
{
    const uint32_t thick = std::max(12u, evenAbove(2.3 * supportInSpacings(def_.neighbors)));
    side_ = std::max(16u, 4 * uint32_t(std::lround(0.25 * std::sqrt(double(settings.particles) / thick))));
    const double spacing = 1.0 / side_;
    const double volume = spacing * spacing * spacing;
    Lattice{glm::dvec3(0), spacing, {side_, side_, thick}}.forEach([&](const glm::dvec3& p) {
        const bool inside = std::abs(p.y - 0.5) < 0.25;
        const double density = inside ? kDense : kThin;
        const double wave = base::sinCosTurns(kWaves * p.x - std::round(kWaves * p.x)).sin *
                            (gaussian((p.y - 0.25) / kSeedWidth) + gaussian((p.y - 0.75) / kSeedWidth));
        particles_.push_back({p,
                              {inside ? kSpeed : -kSpeed, kSeed * wave, 0},
                              density * volume,
                              kPressure / ((gamma_ - 1) * density)});
    });
    def_.domain.axes.fill(AxisKind::Periodic);
    def_.domain.low = glm::dvec3(0);
    def_.domain.high = glm::dvec3(1, 1, thick * spacing);
    finish(kSamples);
}

/// The share of the wave in the velocity across the boundaries, weighted as the wave itself falls off.
void KelvinHelmholtzCase::look(double time, std::span<const CaseParticle> particles)
{
    const double wavenumber = 2 * std::numbers::pi * kWaves;
    double sine = 0;
    double cosine = 0;
    double weights = 0;
    for (const CaseParticle& p : particles) {
        const double weight = p.mass / p.density * std::exp(-wavenumber * toBoundary(p.position.y));
        sine += weight * p.velocity.y * std::sin(wavenumber * p.position.x);
        cosine += weight * p.velocity.y * std::cos(wavenumber * p.position.x);
        weights += weight;
    }
    amplitudes_.push_back({time, 2 * std::hypot(sine, cosine) / weights});
}

/// Slope of the logarithm, by least squares.
double KelvinHelmholtzCase::growthRate() const
{
    double n = 0;
    double t = 0;
    double a = 0;
    double tt = 0;
    double ta = 0;
    for (const Amplitude& amplitude : amplitudes_) {
        if (amplitude.time < kFrom - 1e-9 || amplitude.time > kTo + 1e-9)
            continue;
        const double logarithm = std::log(amplitude.value);
        n += 1;
        t += amplitude.time;
        a += logarithm;
        tt += amplitude.time * amplitude.time;
        ta += amplitude.time * logarithm;
    }
    return n < 3 ? kNotMeasured : (n * ta - t * a) / (n * tt - t * t);
}

ProfilePoint KelvinHelmholtzCase::seen(const CaseParticle& particle) const
{
    return {particle.position.x, particle.mass, {particle.density, particle.velocity.x, particle.pressure}};
}

CaseMeasures KelvinHelmholtzCase::measure(std::span<const CaseParticle>) const
{
    const ShearLayer layer{2 * std::numbers::pi * kWaves,
                           kDense,
                           kThin,
                           kSpeed,
                           -kSpeed,
                           std::sqrt(gamma_ * kPressure / kDense),
                           std::sqrt(gamma_ * kPressure / kThin)};
    const double growth = growthRate();
    CaseMeasures out;
    out.more.push_back({"growth_rate", growth, "of the wave [1/s]; linear theory", layer.growth()});
    out.more.push_back({"growth_rate_incompressible", growth, "the same; theory without compressibility",
                        layer.incompressibleGrowth()});
    for (const Amplitude& amplitude : amplitudes_) {
        const double tenths = amplitude.time * 10;
        if (std::abs(tenths - std::round(tenths)) < 1e-6)
            out.more.push_back({"amplitude_" + std::to_string(std::lround(tenths)), amplitude.value,
                                "of the wave's speed after so many tenths of a second [m/s]"});
    }
    if (ownTime_ && side_ >= 64)
        out.limits.push_back(
            {"growth_rate", growth, 0.8 * layer.incompressibleGrowth(), 1.2 * layer.incompressibleGrowth()});
    return out;
}

} // namespace

std::unique_ptr<GasCase> makeKelvinHelmholtzCase(const CaseSettings& settings)
{
    return std::make_unique<KelvinHelmholtzCase>(settings);
}

} // namespace fx::sim
