/// @file snapshot_match.h
/// Finds matching groups of two snapshots, and interpolates their placement.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>

namespace fx::render {

constexpr size_t kNoGroup = ~size_t(0);

/// Returns the index of the group of `older` that is a given group of `newer`, or kNoGroup if `older` has no
/// such group. Both have the same name (instance, solver and kind), and the same number of groups of this
/// name before them, as a solver may publish several of one kind.
/// @param older may be null @param index of the group of `newer`; the same index in `older` is tested first
size_t findSameGroup(const base::FrameSnapshot* older, const base::FrameSnapshot& newer, size_t index);

/// Returns the placement of a group relative to `eye`, interpolated between the snapshots; t = 1 gives the
/// newer snapshot.
/// @param older may be null
base::Placement placementAt(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float t,
                            const glm::dvec3& eye);

/// Returns the placement at which a frame shows a group: that of SnapshotPair::shown if it lists the
/// instance and the group does not stay in the world, else the placement interpolated between the snapshots.
/// @param snapshots pair of the frame @param newer group of the newer snapshot @param older may be null
base::Placement placementAt(const base::SnapshotPair& snapshots, const base::SnapshotGroup& newer,
                            const base::SnapshotGroup* older, float t, const glm::dvec3& eye);

/// Entry of SnapshotPair::shown for an instance; null if there is none.
const base::ShownPlacement* shownPlacement(const base::SnapshotPair& snapshots, uint64_t instance);

/// World velocity of points that are fixed in the local space of a group, as an affine function.
struct PlaceDrift
{
    glm::mat3 turn{0.0f};  ///< [1/s]
    glm::vec3 shift{0.0f}; ///< [m/s]

    glm::vec3 at(const glm::vec3& local) const { return turn * local + shift; }
};

/// Computes the world velocity due to the motion of the placement.
/// @param older null: the placement is constant
/// @param seconds [s] time between the two snapshots
PlaceDrift placeDrift(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float seconds);

} // namespace fx::render
