#include "simulation/sph/gas_release.h"

#include "foundation/math/elementary.h"
#include "foundation/random/philox.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/sph/gas_density.h"
#include "simulation/sph/gas_forces.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

namespace column = gas_column;

constexpr float kSmallestSpacing = 1e-3f;        ///< [m] so that neither masses nor smoothing lengths vanish
constexpr double kBallVolume = 4.18879020478639; ///< of radius 1

float spacingOf(const GasDef& def)
{
    const float even = def.radius * float(base::cubeRoot(kBallVolume / double(std::max(def.particles, 1u))));
    return std::max(even, kSmallestSpacing);
}

double fraction(double x)
{
    return x - std::floor(x);
}

/// Particle i of the evenly filled unit ball.
glm::vec3 placeInBall(uint32_t i)
{
    constexpr double kPhi = 1.22074408460575947536;
    const double u1 = fraction(0.5 + i / kPhi); // (2)
    const double u2 = fraction(0.5 + i / (kPhi * kPhi));
    const double u3 = fraction(0.5 + i / (kPhi * kPhi * kPhi));
    const double r = base::cubeRoot(u1); // (3)
    const double cosine = 1.0 - 2.0 * u2;
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    const base::SinCos azimuth = base::sinCosTurns(u3);
    return {float(r * sine * azimuth.cos), float(r * cosine), float(r * sine * azimuth.sin)};
}

} // namespace

float releaseSmoothing(const GasDef& def)
{
    return kNeighborhood * spacingOf(def);
}

void releaseGas(const GasDef& def, const StepContext& context, GasStore& gas)
{
    const float intensity = std::max(context.parameters->intensity, 0.0f);
    const float pressure = std::max(1.0f + (def.pressureRatio - 1.0f) * intensity, 0.05f);
    const float density = pressure * kAirDensity * kAirTemperature / def.temperature; // (1)
    const float spacing = spacingOf(def);
    gas.count = uint32_t(gas.columns[0].capacity());
    gas.mass = density * spacing * spacing * spacing;

    for (uint32_t i = 0; i < gas.count; ++i) {
        const std::array<float, 4> u =
            base::randomUnit4(context.seed, context.solverIndex, i, base::RandomPurpose::Gas);
        const glm::vec3 inBall = placeInBall(i);
        const glm::vec3 shift(u[0] - 0.5f, u[1] - 0.5f, u[2] - 0.5f);
        const glm::vec3 position =
            def.position + def.radius * inBall + 2.0f * def.jitter * spacing * shift; // (4)
        const glm::vec3 velocity = def.initialBias + def.initialSpeed * inBall;
        gas.at(column::X)[i] = position.x;
        gas.at(column::Y)[i] = position.y;
        gas.at(column::Z)[i] = position.z;
        gas.at(column::VelocityX)[i] = velocity.x;
        gas.at(column::VelocityY)[i] = velocity.y;
        gas.at(column::VelocityZ)[i] = velocity.z;
        gas.at(column::Smoothing)[i] = releaseSmoothing(def);
        gas.at(column::Temperature)[i] = def.temperature;
        gas.at(column::Mixing)[i] = 1.0f;
        gas.at(column::Exposure)[i] = 0.0f;
        gas.at(column::Vigor)[i] = 0.6f + 0.8f * u[3];
        gas.at(column::Soot)[i] = 0.0f;
        gas.at(column::Presence)[i] = 1.0f;
    }
}

} // namespace fx::sim
