/// @file ribbon_def.h
/// Definitions of trails and lights of an emitter's particles.
#pragma once

#include "foundation/math/curve.h"
#include "simulation/particles/emitter_appearance.h"

#include <cstdint>

namespace fx::sim {

/// A ribbon along the path of each particle.
struct RibbonDef
{
    float lifetime = 0;    ///< [s] time for which a point of the path remains part of the ribbon; 0: no trail
    float width = 0.1f;    ///< [m] > 0
    float minDistance = 0; ///< [m] smallest distance between points
    uint32_t maxPoints = 32; ///< 2..256
    float arcPerTile = 1.0f; ///< [m] see base::particle_constant
    float edge = 0.0f;       ///< [1] see base::particle_constant
    float softEnds = 0.0f;   ///< [m] length over which both ends fade
    /// Appearance of the ribbon. Only blend, order, luminance, lit, softness and texture are used.
    EmitterAppearance appearance;
    /// Factor on the width, as a function of the age of a point divided by `lifetime`, 0..1.
    base::ScalarCurve widthAlong{std::array{1.0f}};
    base::ColorCurve colorAlong{std::array{1.0f, 1.0f, 1.0f}}; ///< linear Rec. 709
    base::ScalarCurve opacityAlong{std::array{1.0f}};
};

/// The light with which particles illuminate their surroundings.
struct LightDef
{
    bool given = false;
    /// [cd] intensity of a particle of color 1; 0: the luminance of the particle times its projected area
    float intensity = 0;
    uint32_t maxLights = 16; ///< maximum number of lights; the brightest lights are published
    bool merged = false;     ///< true: one light represents all particles
};

} // namespace fx::sim
