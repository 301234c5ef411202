/// @file turn.h
/// Rotation from +Y onto an axis.
///
/// @formula shortest-turn
/// The rotation by the smallest angle that maps +Y to a unit vector.
///
/// symbol   unit   meaning
///   a       1      unit vector
///   w       1      +Y x a
///   v       any    vector to rotate
/// @derivation
///   Rodrigues' formula with the angle's sine |w| and cosine a.y:
///       v' = v + w x v + (w x (w x v)) / (1 + a.y)                                            (1)
///   The inverse rotation is the one that maps +Y to (-a.x, a.y, -a.z)                         (2)
/// @source    elementary
/// @deviation for a = -Y the rotation is not unique; half a turn around +X is used
/// @valid     |a| = 1; a = +Y does not change v
/// @accuracy  float rounding, growing as 1 / (1 + a.y)
/// @tests     tests/simulation/particles/modules/test_shapes.cpp
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace fx::sim {

/// A unit vector along `v`; +Y if `v` is zero.
inline glm::vec3 unitOrUp(const glm::vec3& v)
{
    const float size = glm::length(v);
    return size > 0.0f ? v / size : glm::vec3(0.0f, 1.0f, 0.0f);
}

inline glm::vec3 turnFromY(const glm::vec3& axis, const glm::vec3& v)
{
    const float squared = axis.x * axis.x + axis.z * axis.z;
    if (axis.y < 0.0f && squared < 1e-12f)
        return {v.x, -v.y, -v.z};
    if (squared == 0.0f)
        return v;
    const glm::vec3 w(axis.z, 0.0f, -axis.x);
    const glm::vec3 once = glm::cross(w, v);
    return v + once + glm::cross(w, once) / (1.0f + axis.y); // (1)
}

inline glm::vec3 turnToY(const glm::vec3& axis, const glm::vec3& v)
{
    return turnFromY({-axis.x, axis.y, -axis.z}, v); // (2)
}

} // namespace fx::sim
