/// @file blob_radiance.h
/// Computes the light that a group of balls emits, along lines through the group.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <glm/vec3.hpp>

#include <cstddef>

namespace fx::render {

/// [cd/m2] Emitted light per optical depth of one ball of a group of the kind "blob".
glm::vec3 blobSource(const base::SnapshotGroup& group, size_t ball);

/// [m2] Effective area of a ball of medium, by equation (1) of formula light-of-media.
float blobArea(float crossSection, float radius);

/// Intensity of the group, as a mean over all directions, by equations (2) to (4) of formula light-of-media.
/// The intensity includes the occlusion of balls by each other, and detail. Equal input gives equal bits. If
/// the balls move smoothly, the intensity changes smoothly.
/// @param group index of a group of the kind "blob"
/// @return [cd] in the space of the group: not multiplied by the square of its scale
glm::vec3 blobIntensity(const base::FrameSnapshot& snapshot, size_t group);

} // namespace fx::render
