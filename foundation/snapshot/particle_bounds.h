/// @file particle_bounds.h
/// How far a group of particles or ribbons reaches, from its state alone: everything that is drawn of it lies
/// inside.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/snapshot/particle_kind.h"

namespace fx::base {

/// Local bounds of everything that a group of the kind "particle" shows at the moment of its snapshot and, of
/// those born since, up to `secondsBack` before it, seen from anywhere: sprites turned and stretched any way,
/// meshes in any orientation. Between two snapshots a group lies inside of the union of both. Rows that are
/// empty or not finite do not count.
/// @param meshReach [1] farthest vertex of the mesh, 0 for sprites  @param secondsBack [s] >= 0
Bounds particleBounds(const SnapshotGroup& group, float meshReach, float secondsBack);

/// The same of a group of the kind "ribbon".
Bounds ribbonBounds(const SnapshotGroup& group);

} // namespace fx::base
