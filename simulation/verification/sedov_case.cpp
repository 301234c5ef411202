/// @file sedov_case.cpp
/// Energy 1 in the 32 particles around the middle of a periodic unit box of density 1. The origin of
/// the box is moved to the middle, between particles: 8 are nearest, 24 next, and together they are the 32.

#include "simulation/verification/case_base.h"
#include "simulation/verification/flow_errors.h"
#include "simulation/verification/gas_cases.h"
#include "simulation/verification/lattice.h"
#include "simulation/verification/sedov_blast.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace fx::sim {
namespace {

constexpr double kEnergy = 1;            ///< [J]
constexpr double kPressure = 1e-6;       ///< [Pa] before the blast
constexpr double kCoreSpacings2 = 2.751; ///< squared distance of the 24, 11/4, rounded up
constexpr uint32_t kCore = 32;
constexpr double kTime = 0.05;
constexpr uint32_t kSamples = 10;

class SedovCase final : public CaseBase
{
public:
    explicit SedovCase(const CaseSettings& settings);
    CaseMeasures measure(std::span<const CaseParticle> particles) const override;
    double energyTolerance() const override { return 2e-4; }

private:
    void addLimits(CaseMeasures& out) const;

    uint32_t side_;
};

SedovCase::SedovCase(const CaseSettings& settings)
    : CaseBase(settings, 5.0 / 3.0, kTime), side_(evenSide(settings.particles, 8))
{
    const double spacing = 1.0 / side_;
    const double mass = spacing * spacing * spacing;
    const double cold = kPressure / (gamma_ - 1);
    const Lattice lattice{glm::dvec3(-0.5), spacing, glm::u32vec3(side_)};
    lattice.forEach([&](const glm::dvec3& position) {
        const bool hot = glm::dot(position, position) < kCoreSpacings2 * spacing * spacing;
        particles_.push_back({position, glm::dvec3(0), mass, cold + (hot ? kEnergy / (kCore * mass) : 0)});
    });
    def_.domain.axes.fill(AxisKind::Periodic);
    def_.domain.low = glm::dvec3(-0.5);
    def_.domain.high = glm::dvec3(0.5);
    finish(kSamples);
}

CaseMeasures SedovCase::measure(std::span<const CaseParticle> particles) const
{
    const SedovBlast exact(gamma_, kEnergy, 1);
    const FlowState behind = exact.behindShock(time_);
    const std::vector<ProfilePoint> points = profileOf(*this, particles);
    CaseMeasures out;
    out.shockRadiusExact = exact.shockRadius(time_);
    const std::vector<Shell> shells = shellsOf(points, 0.5 / side_);
    out.shockRadius = densestRadius(shells);
    storeErrors(
        points, 1.25 * out.shockRadiusExact, {1, behind.velocity, behind.pressure},
        [&](double r) { return exact.at(r, time_); }, out);
    double top = 0;
    for (const Shell& shell : shells)
        top = std::fmax(top, shell.state.density);
    out.more.push_back({"peak_density", top, "largest mean density of a shell [kg/m3]", behind.density});
    addLimits(out);
    return out;
}

/// The limits are those of 32^3 and 64^3 particles and of the time they were chosen for.
void SedovCase::addLimits(CaseMeasures& out) const
{
    if (!ownTime_ || side_ < 32)
        return;
    const bool fine = side_ >= 64;
    out.limits.push_back({"l1_density", out.l1Density, 0, fine ? 0.15 : 0.25});
    out.limits.push_back({"l1_velocity", out.l1Velocity, 0, fine ? 0.105 : 0.165});
    const double tolerance = fine ? 0.02 : 0.04;
    out.limits.push_back({"shock_radius", out.shockRadius, (1 - tolerance) * out.shockRadiusExact,
                          (1 + tolerance) * out.shockRadiusExact});
}

} // namespace

std::unique_ptr<GasCase> makeSedovCase(const CaseSettings& settings)
{
    return std::make_unique<SedovCase>(settings);
}

} // namespace fx::sim
