/// @file thermal_flow.h
/// The air in and around a rising cloud: up through the middle, down along the rim, in at the foot. It is
/// what turns a rising fireball into a mushroom.
///
/// @formula hill-vortex
/// Hill's spherical vortex in the frame of the ground.
///
/// symbol   unit   meaning
///   a       m      radius of the sphere that the cloud fills
///   U       m/s    speed at which it rises
///   s, r    m      position relative to its center, and its length
///   z       m      s along the upward unit vector e
///   u       m/s    velocity of the air
/// @derivation
///   Inside, in the frame of the sphere, the stream function -(3 U / 4)(1 - r^2/a^2) (r^2 - z^2) gives
///       w = (3 U / 2) [ (1 - (2 r^2 - z^2) / a^2) e + (z / a^2) (s - z e) ],  u = w + U e         (1)
///   Outside, the potential flow around a sphere:
///       u = (U a^3 / 2) (3 z s / r^5 - e / r^3)                                                   (2)
///   Both are free of divergence and meet at r = a.
///   The cloud's sphere is that of a uniform ball with the same mean square distance q from the center, by
///   mass:
///       a^2 = 5/3 q                                                                               (3)
///   What turns the cloud over must not lift it: the mean of u over its particles is taken off.     (4)
/// @source    [TUR64] Turner, "The flow into an expanding spherical vortex", doi:10.1017/S0022112064000544,
/// for thermals
///            as Hill vortices; [BAT67] section 7.2 for (1), (2)
/// @deviation (4); the sphere's growth is left to the particles; the ground is not mirrored
/// @valid     a > 0; a cloud that does not rise makes no flow
/// @accuracy  float rounding; continuous at r = a within 1e-5 U
/// @tests     tests/simulation/test_thermal_flow.cpp
#pragma once

#include "simulation/sph/dynamics/gas_dynamics.h"

#include <glm/vec3.hpp>

namespace fx::sim {

struct ThermalFlow
{
    glm::vec3 center{0.0f}; ///< [m]
    glm::vec3 up{0.0f};     ///< unit; zero for no flow
    float radius = 1;       ///< [m] a, > 0
    float speed = 0;        ///< [m/s] U
    glm::vec3 mean{0.0f};   ///< [m/s] of u over the particles

    bool active() const { return speed != 0.0f; }
    /// [m/s] of the air at `position`.
    glm::vec3 velocity(const glm::vec3& position) const;
    /// The velocity without the mean lift of the cloud.
    glm::vec3 circulation(const glm::vec3& position) const { return velocity(position) - mean; }
};

/// The flow that the gas as a whole makes. Sums run over the particles in the order of their places.
/// @param wind [m/s] in which the cloud drifts
ThermalFlow measureThermal(const GasView<float>& gas, const glm::vec3& gravity, const glm::vec3& wind);

} // namespace fx::sim
