/// @file snapshot_match.h
/// Matching groups of two snapshots, and their interpolated placement.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <glm/vec3.hpp>

#include <cstddef>

namespace fx::render {

constexpr size_t kNoGroup = ~size_t(0);

/// Index of the group of the same instance, solver and kind; kNoGroup when it does not exist.
/// @param older may be null @param hint most likely index
size_t findSameGroup(const base::FrameSnapshot* older, const base::GroupName& name, size_t hint);

/// Placement of a group, relative to `eye`, interpolated by `t` towards the newer snapshot.
/// @param older may be null
base::Placement placementAt(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float t,
                            const glm::dvec3& eye);

} // namespace fx::render
