/// @file blob_radiance.h
/// The light that a group of balls sends out, by lines through the group.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <glm/vec3.hpp>

#include <cstddef>

namespace fx::render {

/// Source of one ball of a group of the kind "blob". [cd/m2]
glm::vec3 blobSource(const base::SnapshotGroup& group, size_t ball);

/// [m2] area that a ball of medium seems to have: formula light-of-media (1).
float blobArea(float crossSection, float radius);

/// Mean intensity of the group over all directions, with what its balls hide of each other and with its
/// detail: formula light-of-media (2) to (4). Equal input gives equal bits; it changes as smoothly as the
/// balls move.
/// @param group number of a group of the kind "blob"
/// @return [cd] in the space of the group: not multiplied by the square of its scale
glm::vec3 blobIntensity(const base::FrameSnapshot& snapshot, size_t group);

} // namespace fx::render
