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
    float lifetime = 0;           ///< [s] the ribbon shows the path of this last time; 0: no trail
    float width = 0.1f;           ///< [m] > 0
    float minDistance = 0;        ///< [m] between points
    uint32_t maxPoints = 32;      ///< 2..256
    float arcPerTile = 1.0f;      ///< [m] see base::particle_constant
    float edge = 0.0f;            ///< [1] see base::particle_constant
    float softEnds = 0.0f;        ///< [m] length over which both ends fade
    EmitterAppearance appearance; ///< blend, order, luminance, lit, softness and texture of the ribbon
    base::ScalarCurve widthAlong{std::array{1.0f}};            ///< t in [0, 1]: age of the point / lifetime
    base::ColorCurve colorAlong{std::array{1.0f, 1.0f, 1.0f}}; ///< linear Rec. 709
    base::ScalarCurve opacityAlong{std::array{1.0f}};
};

/// The light that particles emit on their surroundings.
struct LightDef
{
    bool given = false;
    float intensity = 0;     ///< [cd] of a particle of color 1; 0: its luminance times its projected area
    uint32_t maxLights = 16; ///< the brightest are kept
    bool merged = false;     ///< true: one light represents all particles
};

} // namespace fx::sim
