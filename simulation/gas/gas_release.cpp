#include "simulation/gas/gas_release.h"

#include "foundation/math/elementary.h"
#include "foundation/random/philox.h"
#include "simulation/motion/ambient_air.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::sim {

namespace {

constexpr double kBallVolume = 4.18879020478639; ///< of radius 1
constexpr uint32_t kJets = 6;
constexpr uint32_t kJetKey = 0x4A455453; ///< keeps the jets' random numbers apart from the particles'

double fraction(double x)
{
    return x - std::floor(x);
}

glm::dvec3 onSphere(double u, double v)
{
    const double cosine = 1.0 - 2.0 * u;
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    const base::SinCos azimuth = base::sinCosTurns(v);
    return {sine * azimuth.cos, cosine, sine * azimuth.sin};
}

/// Directions into which the charge is thrown harder, or less.
struct Jets
{
    Jets(const StepContext& context)
    {
        for (uint32_t k = 0; k < kJets; ++k) {
            const std::array<float, 4> u =
                base::randomUnit4(context.seed, context.solverIndex ^ kJetKey, k, base::RandomPurpose::Gas);
            direction[k] = onSphere(double(u[0]), double(u[1]));
            strength[k] = 2.0 * double(u[2]) - 1.0;
        }
    }
    double at(const glm::dvec3& d) const
    {
        double sum = 0;
        for (uint32_t k = 0; k < kJets; ++k) {
            const double c = std::max(glm::dot(d, direction[k]), 0.0);
            sum += strength[k] * (c * c) * (c * c); // (3)
        }
        return sum;
    }
    std::array<glm::dvec3, kJets> direction;
    std::array<double, kJets> strength;
};

} // namespace

double spacingOf(const ChargePlan& plan, uint32_t particles)
{
    return plan.radius * base::cubeRoot(kBallVolume / double(particles));
}

base::Status releaseGas(const GasDef& def, const ChargePlan& plan, const StepContext& context,
                        std::span<GasParticle> scratch, GasDynamics<float>& gas, GasParcels& parcels)
{
    constexpr double kPhi = 1.22074408460575947536;
    const Jets jets(context);
    const double spacing = spacingOf(plan, uint32_t(scratch.size()));
    const double lumps = double(def.lumpiness);
    for (uint32_t i = 0; i < scratch.size(); ++i) {
        const std::array<float, 4> u =
            base::randomUnit4(context.seed, context.solverIndex, i, base::RandomPurpose::Gas);
        const double r = base::cubeRoot(fraction(0.5 + i / kPhi));
        const glm::dvec3 d =
            onSphere(fraction(0.5 + i / (kPhi * kPhi)), fraction(0.5 + i / (kPhi * kPhi * kPhi)));
        const glm::dvec3 shift = glm::dvec3(u[0], u[1], u[2]) - 0.5;
        const double uneven = lumps * jets.at(d);

        GasParticle& particle = scratch[i];
        particle.position = glm::dvec3(def.position) + plan.radius * r * (1.0 + 0.25 * uneven) * d +
                            2.0 * double(def.jitter) * spacing * shift; // (4)
        particle.position.y = std::max(particle.position.y, double(context.groundHeight) + 0.25 * spacing);
        particle.velocity = glm::dvec3(def.initialBias) +
                            double(def.throwSpeed) * plan.rimSpeed * r * std::max(1.0 + uneven, 0.0) * d;
        particle.mass = plan.mass / double(scratch.size());
        particle.energy = plan.pressure / ((plan.gamma - 1.0) * plan.density);
        parcels.fire[i] = startParcel(*def.material, particle.mass);
        parcels.vigor[i] = 0.8f + 0.4f * u[3];
        parcels.presence[i] = 1.0f;
    }
    return gas.add(scratch);
}

} // namespace fx::sim
