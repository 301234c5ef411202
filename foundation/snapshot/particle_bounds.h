/// @file particle_bounds.h
/// Computes the bounds of a group of particles or ribbons from its state. All drawn geometry of the group
/// lies inside the bounds.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/snapshot/particle_kind.h"

namespace fx::base {

/// Local bounds of a group of the kind "particle" at the time of its snapshot, for any view direction,
/// stretch and orientation. For particles born within the last `secondsBack`, their path since birth is
/// included. At a moment between two snapshots, a group lies inside the union of its bounds in both
/// snapshots. Rows that are empty or not finite are ignored.
/// @param meshReach [1] MeshAsset::reach of the mesh, 0 for sprites  @param secondsBack [s] >= 0
Bounds particleBounds(const SnapshotGroup& group, float meshReach, float secondsBack);

/// Local bounds of a group of the kind "ribbon".
Bounds ribbonBounds(const SnapshotGroup& group);

} // namespace fx::base
