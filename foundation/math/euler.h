/// @file euler.h
/// Rotations that authors give as angles.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

namespace fx::base {

/// Converts angles [degree] to a rotation about x, then y, then z.
inline glm::quat rotationOf(const glm::dvec3& degrees)
{
    const glm::dvec3 angles = glm::radians(degrees);
    return glm::quat(glm::angleAxis(angles.z, glm::dvec3(0, 0, 1)) *
                     glm::angleAxis(angles.y, glm::dvec3(0, 1, 0)) *
                     glm::angleAxis(angles.x, glm::dvec3(1, 0, 0)));
}

} // namespace fx::base
