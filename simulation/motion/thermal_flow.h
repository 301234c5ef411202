/// @file thermal_flow.h
/// The air flow in and around a rising cloud: up in the middle, down along the rim, inwards at the bottom.
/// This circulation gives a rising fireball the shape of a mushroom.
///
/// @formula hill-vortex
/// Hill's spherical vortex in the frame of the ground.
///
/// symbol   unit   meaning
///   a       m      radius of the sphere that represents the cloud
///   U       m/s    rising speed of the cloud
///   s, r    m      position relative to its center, and its length
///   z       m      s along the upward unit vector e
///   u       m/s    velocity of the air
///   p, g    m      position, height of the ground
///   '              mirrored: p' = (p_x, 2 g - p_y, p_z), u' = (u_x, -u_y, u_z)
/// @derivation
///   Inside, in the frame of the sphere, the stream function -(3 U / 4)(1 - r^2/a^2) (r^2 - z^2) gives
///       w = (3 U / 2) [ (1 - (2 r^2 - z^2) / a^2) e + (z / a^2) (s - z e) ],  u = w + U e         (1)
///   Outside, the potential flow around a sphere:
///       u = (U a^3 / 2) (3 z s / r^5 - e / r^3)                                                   (2)
///   Both flows are divergence-free and continuous at r = a.
///   No air crosses the ground: the sum of the flow and its mirror image,
///       u_g(p) = u(p) + u(p')'                                                                    (3)
///   has no vertical component on the ground, where p' = p.
/// @source    [TUR64] Turner, "The flow into an expanding spherical vortex",
///            doi:10.1017/S0022112064000544, for thermals as Hill vortices; [BAT67] section 7.2 for (1),
///            (2); (3) is the method of images
/// @deviation the growth of the sphere is not part of the flow; it follows from the particles
/// @valid     a > 0; without rising there is no flow; without ground (3) is u
/// @accuracy  float rounding; continuous at r = a within 1e-5 U; (3) is exactly 0 along y at the ground
/// @tests     tests/simulation/test_thermal_flow.cpp
#pragma once

#include <glm/vec3.hpp>

namespace fx::sim {

struct ThermalFlow
{
    glm::vec3 center{0.0f}; ///< [m]
    glm::vec3 up{0.0f};     ///< direction in which the thermal rises, a unit vector; zero: no flow
    float radius = 1;       ///< [m] radius a of the formula, > 0
    float speed = 0;        ///< [m/s] speed U of the formula
    glm::vec3 mean{0.0f};   ///< [m/s] mean velocity u over the particles

    bool active() const { return speed != 0.0f; }
    /// [m/s] Velocity of the air at `position`, without ground.
    glm::vec3 velocity(const glm::vec3& position) const;
    /// [m/s] Velocity of the air at `position` above a ground plane.
    /// @param height [m] y coordinate of the ground; -infinity: no ground
    glm::vec3 velocityAbove(float height, const glm::vec3& position) const;
    /// [m/s] Velocity minus the mean velocity over the particles.
    glm::vec3 circulation(const glm::vec3& position) const { return velocity(position) - mean; }
};

} // namespace fx::sim
