/// @file birth_shape.h
/// Position and direction of a birth, as a function of random numbers.
///
/// @formula birth-shapes
/// Uniform samples of ball, box, disc and cone of directions.
///
/// symbol   unit   meaning
///   u1..u4  1      independent uniform numbers in [0, 1)
///   R       m      radius
///   alpha   rad    half angle of the cone
/// @derivation
///   direction with z = cos: c = 1 - u1 (1 - cos alpha), azimuth u2 turns; alpha = pi is the sphere   (1)
///   radius in the ball R u^(1/3), in the disc R u^(1/2): volume and area below r are uniform            (2)
/// @source    elementary (inversion of the distribution function)
/// @deviation none
/// @valid     R = 0 gives the center; alpha is clamped to [0, pi]
/// @accuracy  float rounding
/// @tests     tests/simulation/test_birth_shape.cpp
#pragma once

#include "simulation/particles/emitter_settings.h"

#include <array>

namespace fx::sim {

/// Initial position and direction of a particle, in the instance's local space.
struct BirthPlace
{
    glm::vec3 position;  ///< [m]
    glm::vec3 direction; ///< unit vector
};

/// Computes the initial position and direction of a particle from random numbers.
/// @param place four uniform numbers for the position
/// @param heading four uniform numbers for the direction
BirthPlace sampleBirth(const EmitterSettings& def, const std::array<float, 4>& place,
                       const std::array<float, 4>& heading);

} // namespace fx::sim
