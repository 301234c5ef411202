/// @file medium_caster.h
/// A ball of medium that casts a shadow.
#pragma once

#include <glm/vec3.hpp>

namespace fx::render {

/// A ball of medium with the quartic kernel.
struct MediumCaster
{
    glm::vec3 center;   ///< [m] position relative to the eye
    float radius;       ///< [m] > 0
    float crossSection; ///< [m2] extinction cross section, >= 0
};

} // namespace fx::render
