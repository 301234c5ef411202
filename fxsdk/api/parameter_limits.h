/// @file parameter_limits.h
/// Ranges of the parameters of instances.
#pragma once

#include "simulation/world/instance_clock.h"

#include <cstdint>

namespace fx::api {

constexpr float kHighestIntensity = 1e3f; ///< [1]
constexpr float kStrongestWind = 1e3f;    ///< [m/s] of a component
constexpr float kHighestTint = 1.0f;      ///< [1] of a component
constexpr float kHighestSpeed = 16.0f;    ///< [1]

/// The rate of a clock for a speed within 0 and kHighestSpeed.
inline uint32_t toRate(float speed)
{
    return uint32_t(speed * float(sim::kNormalRate) + 0.5f);
}

} // namespace fx::api
