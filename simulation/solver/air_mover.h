/// @file air_mover.h
/// Interface of solvers whose matter sets the surrounding air in motion.
#pragma once

#include "simulation/motion/thermal_flow.h"

#include <glm/vec3.hpp>

namespace fx::sim {

/// Maximum number of thermals of an effect that other effects follow. Further thermals are ignored.
constexpr size_t kMaxThermals = 8;

/// A solver whose matter moves the surrounding air. See Solver::airMover().
class AirMover
{
public:
    /// The air flow in the present state. The result depends only on the state and the arguments.
    /// @param gravity [m/s2] local gravity
    /// @param wind [m/s] local wind
    virtual ThermalFlow thermal(const glm::vec3& gravity, const glm::vec3& wind) const = 0;

protected:
    ~AirMover() = default;
};

} // namespace fx::sim
