/// @file sod_case.cpp
/// Sod's tube: density and pressure (1, 1) against (0.125, 0.1), particles of equal mass. The
/// gases are glass, since a lattice that is drawn out along the tube keeps its planes and answers with more
/// pressure than the gas has. The tube is a ring of length 2: the dense gas fills |x| < 1/2, so that the flow
/// is there twice, mirrored. Both count; place and velocity are taken outwards from the middle of the dense
/// gas.

#include "simulation/verification/case_base.h"
#include "simulation/verification/flow_errors.h"
#include "simulation/verification/gas_cases.h"
#include "simulation/verification/glass.h"
#include "simulation/verification/lattice.h"
#include "simulation/verification/riemann_problem.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {
namespace {

const FlowState kDense{1, 0, 1};
const FlowState kThin{0.125, 0, 0.1};
constexpr double kTime = 0.2;
constexpr uint32_t kSamples = 8;

class SodCase final : public CaseBase
{
public:
    explicit SodCase(const CaseSettings& settings);
    ProfilePoint seen(const CaseParticle& particle) const override;
    CaseMeasures measure(std::span<const CaseParticle> particles) const override;

private:
    /// Fills a length of 1 with cubes of glass.
    void addGas(const FlowState& state, double from, double spacing, uint32_t side, uint32_t boxes);

    double spacing_ = 0; ///< [m] of particles of the dense gas
};

SodCase::SodCase(const CaseSettings& settings) : CaseBase(settings, 5.0 / 3.0, kTime)
{
    // Across the tube a support of the thin gas must fit in twice; its particles are twice as far apart.
    const uint32_t across = 2 * evenAbove(1.1 * supportInSpacings(def_.neighbors) * 2);
    const double perLength = across * across * (1 + 0.125);
    const uint32_t boxes = std::max(2u, uint32_t(std::lround(settings.particles / perLength / across)));
    spacing_ = 1.0 / (boxes * across);
    addGas(kDense, -0.5, spacing_, across, boxes);
    addGas(kThin, 0.5, 2 * spacing_, across / 2, boxes);
    def_.domain.axes.fill(AxisKind::Periodic);
    def_.domain.low = glm::dvec3(-0.5, 0, 0);
    def_.domain.high = glm::dvec3(1.5, across * spacing_, across * spacing_);
    finish(kSamples);
}

void SodCase::addGas(const FlowState& state, double from, double spacing, uint32_t side, uint32_t boxes)
{
    const double mass = state.density * spacing * spacing * spacing;
    const double energy = state.pressure / ((gamma_ - 1) * state.density);
    const std::vector<glm::dvec3> box = glassBox(glm::u32vec3(side), def_.neighbors);
    for (uint32_t k = 0; k < boxes; ++k) {
        for (const glm::dvec3& place : box) {
            const glm::dvec3 position =
                glm::dvec3(from, 0, 0) + spacing * (place + glm::dvec3(k * side, 0, 0));
            particles_.push_back({position, glm::dvec3(0), mass, energy});
        }
    }
}

ProfilePoint SodCase::seen(const CaseParticle& particle) const
{
    const double x = particle.position.x;
    const double wrapped = x - 2 * std::floor(0.5 * (x + 1)); // -1 .. 1
    const double sign = wrapped < 0 ? -1 : 1;
    return {sign * wrapped - 0.5,
            particle.mass,
            {particle.density, sign * particle.velocity.x, particle.pressure}};
}

CaseMeasures SodCase::measure(std::span<const CaseParticle> particles) const
{
    const RiemannProblem exact(kDense, kThin, gamma_);
    const std::vector<ProfilePoint> points = profileOf(*this, particles);
    CaseMeasures out;
    storeErrors(
        points, 0.5, {1, 1, 1}, [&](double x) { return exact.at(x / time_); }, out);
    // The shock is the way from the star state to the gas at rest, right of the contact.
    std::vector<ProfilePoint> right;
    const double contact = exact.starVelocity() * time_;
    const double front = exact.rightWaveSpeed() * time_;
    for (const ProfilePoint& point : points) {
        if (point.place > 0.5 * (contact + front))
            right.push_back(point);
    }
    out.shockRadiusExact = front;
    out.shockRadius = shockRadius(shellsOf(right, 0.5 * spacing_), kThin.density);
    return out;
}

} // namespace

std::unique_ptr<GasCase> makeSodCase(const CaseSettings& settings)
{
    return std::make_unique<SodCase>(settings);
}

} // namespace fx::sim
