/// @file shape_sample.h
/// Position and direction of a birth, as a function of random numbers.
///
/// @formula even-shapes
/// Uniform samples of lines, discs, balls, boxes, cones and tori, of their interior or surface.
///
/// symbol   unit   meaning
///   u1..u4   1      independent uniform numbers in [0, 1)
///   R, k     m, 1   radius, share of the radius that stays empty
///   alpha    rad    half angle of the cone
///   q, T     m      radius of the torus's tube and of the circle that it surrounds
///   H        m      height of the cone
/// @derivation
///   direction with z = cos: c = 1 - u1 (1 - cos alpha), azimuth u2 turns; alpha = pi is the sphere   (1)
///   radius in the ball R (k^3 + u (1 - k^3))^(1/3), in the disc R (k^2 + u (1 - k^2))^(1/2): the volume or
///   area below r grows uniformly; on the surface k = 1                                             (2)
///   The cone above the disc has radius r = R + z tan(alpha) at height z. Its volume below z grows as r^3,
///   its lateral area as r^2, so these powers are uniform between their limits. For the cylinder,
///   alpha = 0, z = u H                                                                             (3)
///   In the torus the volume at the angle b around the tube is proportional to T + r cos b. b is drawn
///   uniformly. With the probability (1 - (r / T) cos b) / 2 it is replaced by its mirror image, which
///   inverts the sign of cos b. Then b has the density (T + r cos b) / (2 pi T)                     (4)
///   The radius r in the tube is drawn as in the disc                                               (5)
/// @source    elementary (inversion of the distribution function)
/// @deviation none
/// @valid     R = 0 gives the center; alpha is clamped to [0, pi], q to [0, T]
/// @accuracy  float rounding
/// @tests     tests/simulation/particles/modules/test_shapes.cpp
#pragma once

#include "simulation/particles/shapes/shape_def.h"
#include "simulation/particles/tile.h"

#include <array>
#include <memory>

namespace fx::sim {

/// Initial position and direction of a particle, in the instance's local space.
struct ShapePlace
{
    glm::vec3 position;  ///< [m]
    glm::vec3 direction; ///< unit vector
};

/// Computes the initial position and direction of a particle from random numbers.
/// @param place four uniform numbers for the position
/// @param heading four uniform numbers for the direction
ShapePlace sampleShape(const ShapeDef& def, const std::array<float, 4>& place,
                       const std::array<float, 4>& heading);

/// [1] Growth of the radius of the cone per unit of height.
double slopeOf(const ShapeDef& def);

/// Module that samples the shape for many births at once.
std::unique_ptr<ShapeOp> makeShapeOp(const ShapeDef& def);

/// Definition of a shape that makeShapeOp() created; null for all other shapes.
const ShapeDef* shapeOf(const ShapeOp& shape);

} // namespace fx::sim
