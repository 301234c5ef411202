/// @file noh_case.cpp
/// A sphere of cold gas, radius 1 and density 1, of which every part falls on the center with speed 1. Its
/// free surface stays ahead of everything that is compared.

#include "simulation/verification/case_base.h"
#include "simulation/verification/flow_errors.h"
#include "simulation/verification/gas_cases.h"
#include "simulation/verification/lattice.h"
#include "simulation/verification/noh_implosion.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::sim {
namespace {

constexpr double kPressure = 1e-6; ///< [Pa]
constexpr double kTime = 0.6;
constexpr uint32_t kSamples = 10;

class NohCase final : public CaseBase
{
public:
    explicit NohCase(const CaseSettings& settings);
    CaseMeasures measure(std::span<const CaseParticle> particles) const override;

private:
    double spacing_;
};

NohCase::NohCase(const CaseSettings& settings)
    : CaseBase(settings, 5.0 / 3.0, kTime), spacing_(std::cbrt(4 * std::numbers::pi / 3 / settings.particles))
{
    const uint32_t across = evenAbove(2 / spacing_);
    const double mass = spacing_ * spacing_ * spacing_;
    const double energy = kPressure / (gamma_ - 1);
    const Lattice lattice{glm::dvec3(-0.5 * across * spacing_), spacing_, glm::u32vec3(across)};
    lattice.forEach([&](const glm::dvec3& position) {
        const double r = glm::length(position);
        if (r < 1)
            particles_.push_back({position, -position / r, mass, energy});
    });
    finish(kSamples);
}

CaseMeasures NohCase::measure(std::span<const CaseParticle> particles) const
{
    const NohImplosion exact{gamma_, 1, 1};
    const std::vector<ProfilePoint> points = profileOf(*this, particles);
    CaseMeasures out;
    out.shockRadiusExact = exact.shockSpeed() * time_;
    const FlowState behind = exact.at(0.5 * out.shockRadiusExact, time_);
    const FlowState ahead = exact.at(out.shockRadiusExact, time_);
    // A shell behind the shock is compressed fourfold in each direction.
    const std::vector<Shell> shells = shellsOf(points, 0.5 * spacing_);
    out.shockRadius = shockRadius(shells, ahead.density);
    storeErrors(
        points, 1.25 * out.shockRadiusExact, {1, exact.speed, behind.pressure},
        [&](double r) { return exact.at(r, time_); }, out);
    double plateau = 0;
    for (const Shell& shell : shells)
        plateau = std::max(plateau, shell.state.density);
    out.more.push_back({"plateau_density", plateau,
                        "largest mean density of a shell behind the shock [kg/m3]", behind.density});
    out.more.push_back(
        {"center_density", shells.front().state.density, "density in the middle [kg/m3]", behind.density});
    if (ownTime_ && particles_.size() >= 250'000)
        out.limits.push_back({"plateau_density", plateau, 50, 1.1 * behind.density});
    return out;
}

} // namespace

std::unique_ptr<GasCase> makeNohCase(const CaseSettings& settings)
{
    return std::make_unique<NohCase>(settings);
}

} // namespace fx::sim
