/// @file blob_detail.h
/// Computes the parameters of the detail (procedural noise) of a group of blobs, at a moment between two
/// snapshots.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/field_detail/field_detail_numbers.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace fx::render {

/// Parameters of the detail of all blobs of a group.
struct GroupDetail
{
    FieldDetailNumbers numbers; ///< parameters of formula field-detail; lengths are in the space of the group
    /// Linear parts of two affine maps from a point p to noise coordinates: toCells p + first. The offsets
    /// of blobs are added to the result. The maps belong to two generations of the noise, which are blended.
    glm::mat3 toCells[2];
    glm::vec3 first[2]; ///< [cell] constant parts of the maps; p [m] is relative to the eye, along world axes
    /// [1] Scale of the placement: length in the world divided by length in the group.
    float scale = 1;
    /// [1] Factor of the extinction after erosion by noise. The factor restores the integral of the smooth
    /// extinction.
    float factor = 1;
};

/// [1] Symbol v of formula field-detail, for a single ball.
/// @param crossSection [m2] in the world  @param radius [m] in the world
float thinningOf(const GroupDetail& detail, float crossSection, float radius);

/// Reads the noise coordinates of blobs from the group of the kind "material", which follows the group of
/// blobs.
class BlobDetail
{
public:
    BlobDetail() = default; ///< constructs an object without detail
    /// @param group index of the group of blobs in the newer snapshot of `snapshots`
    /// @param t moment between the snapshots: 0 is the older snapshot, 1 the newer
    BlobDetail(const base::SnapshotPair& snapshots, size_t group, float t);

    /// @param newer, older groups of the coordinates of the same elements; `older` may be null
    BlobDetail(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float t);

    bool isGiven() const { return chosen_ != nullptr; }
    /// Returns the parameters of the detail at the moment.
    /// @param place interpolated placement of the group, relative to the eye
    GroupDetail groupDetail(const base::Placement& place) const;
    /// Returns the offset of a blob's noise coordinates [cell] for each generation.
    /// @param newer, older indices of the blob in the newer and in the older group; `older` is used only if
    ///         hasOlder
    /// @param position [m] position of the blob at the shown time, in the space of the group
    std::array<glm::vec3, 2> carried(size_t newer, size_t older, bool hasOlder,
                                     const glm::vec3& position) const;

private:
    void read(const base::SnapshotGroup& newer, const base::SnapshotGroup* older, float t);

    const base::SnapshotGroup* newer_ = nullptr;
    /// Group whose noise coordinates are used at the moment `t`; null: no detail.
    const base::SnapshotGroup* chosen_ = nullptr;
    /// Group whose places are blended with those of newer_; null: its generations are others. Only places of
    /// balls of blocks change within a generation.
    const base::SnapshotGroup* older_ = nullptr;
    float t_ = 1.0f;
    FieldDetailNumbers numbers_;
};

} // namespace fx::render
