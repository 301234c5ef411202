/// @file evrard_case.cpp
/// Evrard's cloud, density M / (2 pi R^2 r) with M = R = 1 and specific energy 0.05, that falls together by
/// its own motion instead of its weight: v = -2 r. It bounces, and the reference is the flow in one
/// dimension.

#include "simulation/verification/case_base.h"
#include "simulation/verification/flow_errors.h"
#include "simulation/verification/gas_cases.h"
#include "simulation/verification/lattice.h"
#include "simulation/verification/radial_flow.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::sim {
namespace {

constexpr double kEnergy = 0.05; ///< [J/kg]
constexpr double kFall = 2;      ///< [1/s] speed over distance
constexpr double kTime = 0.6;
constexpr uint32_t kSamples = 60;
constexpr int kCells = 1000;

double densityAt(double r)
{
    return 1 / (2 * std::numbers::pi * r);
}

class EvrardCase final : public CaseBase
{
public:
    explicit EvrardCase(const CaseSettings& settings);
    void look(double time, std::span<const CaseParticle> particles) override;
    CaseMeasures measure(std::span<const CaseParticle> particles) const override;
    double energyTolerance() const override { return 1e-2; }

private:
    RadialFlow makeReference() const;

    double hottest_ = 0;    ///< [J] largest thermal energy seen
    double bounceTime_ = 0; ///< [s] when
};

EvrardCase::EvrardCase(const CaseSettings& settings) : CaseBase(settings, 5.0 / 3.0, kTime)
{
    // A sphere of even density, drawn together so that the mass within r is r^2 instead of r^3.
    const double spacing = std::cbrt(4 * std::numbers::pi / 3 / settings.particles);
    const uint32_t across = evenAbove(2 / spacing);
    const Lattice lattice{glm::dvec3(-0.5 * across * spacing), spacing, glm::u32vec3(across)};
    lattice.forEach([&](const glm::dvec3& even) {
        const double r = glm::length(even);
        const glm::dvec3 position = even * std::sqrt(r);
        if (r < 1)
            particles_.push_back({position, -kFall * position, 0, kEnergy});
    });
    for (GasParticle& particle : particles_)
        particle.mass = 1.0 / double(particles_.size());
    finish(kSamples);
}

void EvrardCase::look(double time, std::span<const CaseParticle> particles)
{
    double thermal = 0;
    for (const CaseParticle& particle : particles)
        thermal += particle.mass * particle.pressure / ((gamma_ - 1) * particle.density);
    if (thermal > hottest_) {
        hottest_ = thermal;
        bounceTime_ = time;
    }
}

RadialFlow EvrardCase::makeReference() const
{
    RadialFlowDef def;
    def.gamma = gamma_;
    def.cells = kCells;
    def.outerWall = false;
    def.initial = [this](double r) {
        return FlowState{densityAt(r), -kFall * r, (gamma_ - 1) * densityAt(r) * kEnergy};
    };
    return RadialFlow(def);
}

CaseMeasures EvrardCase::measure(std::span<const CaseParticle> particles) const
{
    RadialFlow reference = makeReference();
    double hottest = 0;
    double bounce = 0;
    for (const double time : sampleTimes()) {
        reference.advanceTo(time);
        if (reference.thermalEnergy() > hottest) {
            hottest = reference.thermalEnergy();
            bounce = time;
        }
    }
    const std::vector<ProfilePoint> points = profileOf(*this, particles);
    CaseMeasures out;
    storeErrors(
        points, 0.8 * reference.radius(), {1, 1, 1}, [&](double r) { return reference.at(r); }, out);
    out.more.push_back({"bounce_time", bounceTime_, "when the cloud is hottest [s]", bounce});
    out.more.push_back({"largest_thermal_energy", hottest_, "then [J]", hottest});
    if (ownTime_ && particles_.size() >= 30'000) {
        out.limits.push_back({"bounce_time", bounceTime_, bounce - 0.02, bounce + 0.02});
        out.limits.push_back({"largest_thermal_energy", hottest_, 0.95 * hottest, 1.05 * hottest});
    }
    return out;
}

} // namespace

std::unique_ptr<GasCase> makeEvrardCase(const CaseSettings& settings)
{
    return std::make_unique<EvrardCase>(settings);
}

} // namespace fx::sim
