/// @file air_mover.h
/// Solvers whose matter moves the air around it.
#pragma once

#include "simulation/motion/thermal_flow.h"

#include <glm/vec3.hpp>

namespace fx::sim {

constexpr size_t kMaxThermals =
    8; ///< maximum number of thermals of an effect that other effects follow; further ones are ignored

/// See Solver::airMover().
class AirMover
{
public:
    /// The flow of the present state, a function of it and of the arguments alone.
    /// @param gravity [m/s2] local  @param wind [m/s] local
    virtual ThermalFlow thermal(const glm::vec3& gravity, const glm::vec3& wind) const = 0;

protected:
    ~AirMover() = default;
};

} // namespace fx::sim
