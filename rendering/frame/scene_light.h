/// @file scene_light.h
/// Lights of a scene, except sun and sky.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

/// A point light, a ball or a spot. The light source itself is not drawn.
struct SceneLight
{
    glm::dvec3 position{0.0};  ///< [m] world
    glm::vec3 intensity{0.0f}; ///< [cd] intensity in every direction; for a spot, inside of the inner angle
    float radius = 0.0f;       ///< [m] radius of a ball of uniform luminance; 0: a point light
    glm::vec3 direction{0.0f, -1.0f, 0.0f}; ///< unit vector, direction in which a spot emits
    /// [rad] half angle up to which a spot has its full intensity
    float innerAngle = std::numbers::pi_v<float>;
    /// [rad] Half angle beyond which a spot is dark, >= innerAngle; pi: light in all directions.
    float outerAngle = std::numbers::pi_v<float>;

    bool isSpot() const { return outerAngle < std::numbers::pi_v<float>; }
    bool isBall() const { return radius > 0.0f; }
};

/// @formula spot-falloff
/// Intensity of a spot in a direction, over its full intensity.
///
/// symbol    unit   meaning
///   c       1      cosine of the angle between the direction and the axis of the spot
///   ci, co  1      cosines of the inner and the outer angle, ci >= co
///   s       1      share
/// @derivation
///   s = x^2 (3 - 2 x),  x = (c - co) / (ci - co), limited to 0..1; if ci = co, a step at c = co   (1)
/// @source    textbook: the cubic Hermite step
/// @deviation none
/// @valid     ci >= co
/// @accuracy  a few roundings
/// @tests     tests/rendering/reference/render/test_scene_lights.cpp
inline double spotFalloff(double cosine, double cosInner, double cosOuter)
{
    if (!(cosInner > cosOuter))
        return cosine >= cosOuter ? 1.0 : 0.0;
    const double x = std::clamp((cosine - cosOuter) / (cosInner - cosOuter), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x); // (1)
}

} // namespace fx::render
