#include "simulation/sph/gas_motion.h"

#include "foundation/math/bits.h"
#include "foundation/random/philox.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/motion/drag_step.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

namespace column = gas_column;
namespace sorted = gas_sorted;

constexpr float kGroundClearance = 0.3f;   ///< [1] of the smoothing length between the ground and a center
constexpr float kGroundRestitution = 0.1f; ///< [1]
constexpr float kInnerDrag = 0.2f;         ///< [1] drag inside the body over drag at its surface

CurlNoise makeNoise(const GasDef& def, const StepContext& step)
{
    const base::Random4 words =
        base::philox({0, 0, step.solverIndex, uint32_t(base::RandomPurpose::Noise)}, step.seed);
    const double turnover = double(def.curlStrength) / std::max(double(def.curlScale), 1e-3); // [1/s]
    return {words[0], def.curlStrength, def.curlScale, 0.25 * turnover * base::toSeconds(step.tick)};
}

glm::vec3 row(const GasStore& gas, size_t first, uint32_t i)
{
    return {gas.at(first)[i], gas.at(first + 1)[i], gas.at(first + 2)[i]};
}

void setRow(GasStore& gas, size_t first, uint32_t i, const glm::vec3& value)
{
    gas.at(first)[i] = value.x;
    gas.at(first + 1)[i] = value.y;
    gas.at(first + 2)[i] = value.z;
}

/// Wind, the cloud's circulation, and turbulence that fades as the gas cools.
glm::vec3 airAround(const GasMotion& motion, const glm::vec3& position, float temperature)
{
    glm::vec3 air = motion.step.wind;
    if (motion.thermal.active())
        air += motion.def.rolling * motion.thermal.circulation(position);
    if (!motion.noise.active())
        return air;
    const float excess = (temperature - kAirTemperature) / (motion.def.temperature - kAirTemperature);
    const float fade = 0.3f + 0.7f * std::sqrt(std::clamp(excess, 0.0f, 1.0f));
    return air + fade * motion.noise.velocity(position);
}

glm::vec3 buoyancyOf(const GasMotion& motion, float temperature)
{
    const float tau = kAirTemperature / temperature;
    return motion.step.gravity * (-motion.def.buoyancy * (1.0f - tau) / (tau + 0.5f)); // (1)
}

glm::vec3 finiteOrZero(const glm::vec3& v, uint32_t& clamped)
{
    if (base::allFinite(&v.x, 3))
        return v;
    ++clamped;
    return glm::vec3(0.0f);
}

glm::vec3 limitSpeed(const glm::vec3& v, float fastest, uint32_t& clamped)
{
    const float speed = glm::length(v);
    if (speed <= fastest)
        return v;
    ++clamped;
    return base::isFinite(speed) ? v * (fastest / speed) : glm::vec3(0.0f);
}

} // namespace

GasMotion::GasMotion(const GasDef& definition, const StepContext& context, const GasStore& gas)
    : def(definition), step(context), noise(makeNoise(definition, context)),
      thermal(measureThermal(gas, context.gravity, context.wind)),
      fastest(20.0f * definition.soundSpeed + std::abs(definition.initialSpeed) +
              glm::length(definition.initialBias) + glm::length(context.wind))
{}

void sampleAir(const GasMotion& motion, GasStore& gas, uint32_t begin, uint32_t end)
{
    for (uint32_t i = begin; i < end; ++i)
        setRow(gas, column::AirX, i,
               airAround(motion, row(gas, column::X, i), gas.at(column::Temperature)[i]));
}

void moveGas(const GasMotion& motion, const NeighborGrid& grid, GasStore& gas, float seconds, uint32_t begin,
             uint32_t end)
{
    const std::span<const uint32_t> order = grid.order();
    for (uint32_t place = begin; place < end; ++place) {
        const uint32_t i = order[place];
        uint32_t clamped = 0;
        glm::vec3 position = row(gas, column::X, i);
        glm::vec3 velocity = row(gas, column::VelocityX, i);
        const glm::vec3 air = row(gas, column::AirX, i);
        const glm::vec3 pressure(gas.sortedAt(sorted::AccelerationX)[place],
                                 gas.sortedAt(sorted::AccelerationY)[place],
                                 gas.sortedAt(sorted::AccelerationZ)[place]);
        const float temperature = gas.at(column::Temperature)[i];
        const float exposure = gas.sortedAt(sorted::Exposure)[place];

        const glm::vec3 acceleration = finiteOrZero(pressure, clamped) + buoyancyOf(motion, temperature);
        const float rate = (motion.def.drag + motion.def.braking * glm::length(velocity - air)) *
                           (kInnerDrag + (1.0f - kInnerDrag) * exposure); // (2)
        const DragStep drag = makeDragStep(double(rate), double(seconds));
        velocity = drag.decay * velocity + drag.share * air + drag.gain * acceleration; // (3)
        velocity = limitSpeed(velocity, motion.fastest, clamped);
        position += seconds * velocity; // (4)

        const float floor = motion.step.groundHeight + kGroundClearance * gas.at(column::Smoothing)[i];
        if (position.y < floor) { // (5)
            position.y = floor;
            velocity.y = velocity.y < 0.0f ? -kGroundRestitution * velocity.y : velocity.y;
        }
        setRow(gas, column::X, i, position);
        setRow(gas, column::VelocityX, i, velocity);
        gas.at(column::Exposure)[i] = exposure;
        gas.clamped[place] = clamped;
    }
}

} // namespace fx::sim
