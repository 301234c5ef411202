/// @file snapshot_match.h
/// The same group in two snapshots, and where it stands in between.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <glm/vec3.hpp>

#include <cstddef>

namespace fx::render {

constexpr size_t kNoGroup = ~size_t(0);

/// Index of the group of the same instance, solver and kind; kNoGroup when there is none.
/// @param older may be null  @param hint where it most likely is
size_t findSameGroup(const base::FrameSnapshot* older, const base::GroupName& name, size_t hint);

/// Where a group stands at share `t` of the way to the newer snapshot, relative to `eye`.
/// @param older may be null
base::Placement placementAt(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float t,
                            const glm::dvec3& eye);

} // namespace fx::render
