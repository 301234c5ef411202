/// @file geometry.h
/// Boxes and placements. World positions have double precision. Positions of particles have single precision
/// and are relative to the position of their instance.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <limits>

namespace fx::base {

/// Axis-aligned box [m]. Starts empty (min > max).
struct Bounds
{
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    void add(const glm::vec3& center, float radius)
    {
        min = glm::min(min, center - radius);
        max = glm::max(max, center + radius);
    }
};

/// Transform of an instance: world = position + rotation * (scale * local).
struct Placement
{
    glm::dvec3 position{0.0};                   ///< [m] position in the world
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f}; ///< unit quaternion
    float scale = 1.0f;                         ///< [1] factor of lengths (not of time), > 0
};

} // namespace fx::base
