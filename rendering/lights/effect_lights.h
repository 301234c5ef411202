/// @file effect_lights.h
/// The light that burning gas and shining particles throw on everything around them, as a few ball lights.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/lights/light.h"

#include <cstddef>
#include <span>

namespace fx::render {

/// Light of one group of blobs, or of the light list of one emitter.
struct EffectLight
{
    glm::dvec3 position; ///< [m] world: center of the emitted light
    glm::vec3 intensity; ///< [cd] in every direction
    float radius;        ///< [m] root mean square extent of the emission, > 0
};

constexpr size_t kMostEffectLights = 4; ///< that drawing takes into account

/// One light for each group that glows, brightest first, as many as fit.
///
/// A blob of cross section s and source B sends B s (1 - exp(-t)) / t candela in every direction, t = 3.5 s /
/// (pi R^2) being its optical depth: thin gas shows all of its medium, thick gas only its face. What stands
/// before it is counted by the same factor with the group's own mean optical depth.
/// A light list (kind "light") counts as one light too, unless its emitter is seen as a medium, which glows
/// by itself.
/// @return how many were written to `out`
size_t effectLights(const base::FrameSnapshot& snapshot, std::span<EffectLight> out);

} // namespace fx::render
