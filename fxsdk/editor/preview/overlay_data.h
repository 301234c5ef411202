/// @file overlay_data.h
/// What overlays show of the particles of a scene.
#pragma once

#include "fxsdk/editor/session/overlays.h"
#include "fxsdk/editor/session/view_projection.h"
#include "fxsdk/fxsdk.hpp"
#include "rendering/lights/slices/media_shadow.h"

namespace fx::editor {

/// Adds bounds and velocities of the newest step to `io`, as chosen. At most 3000 velocities are shown, of
/// particles evenly spread over each group.
void addParticleWires(const fxsdk::Scene& scene, const OverlayChoice& choice, OverlayData& io);

/// Elements of the newest step by the index of their solver, of all instances. A solver that publishes
/// several kinds for its particles counts once.
std::vector<uint32_t> countsBySolver(const fxsdk::Scene& scene, size_t solvers);

/// Counts the disks of the particles on a grid of cells of 8 pixels over the picture that `view` projects to.
/// @param width, height [pixel] of the picture, whose upper left corner is 0, 0
OverdrawMap overdrawOf(const fxsdk::Scene& scene, const ViewProjection& view, int width, int height);

/// Counts the balls of the particles that hold the places of a slice, on the same grid.
/// @param through [m] world position in the slice, which is parallel to the picture
OverdrawMap sliceOf(const fxsdk::Scene& scene, const ViewProjection& view, int width, int height,
                    const glm::dvec3& through);

/// Adds the volumes of the levels of the sun's light slices.
/// @param origin [m] world position to which the block is relative
void addLightSlices(const render::MediaShadowBlock& sun, const glm::dvec3& origin, OverlayData& io);

} // namespace fx::editor
