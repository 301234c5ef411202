/// @file blob_detail.h
/// Computes the detail of a group of blobs at a moment between two snapshots, relative to the eye.
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
    /// Linear parts of the affine maps from a point p to the noise coordinates of each generation: toCells p
    /// + first. The offsets of blobs are added to the result.
    glm::mat3 toCells[2];
    glm::vec3 first[2]; ///< [cell] constant parts of the maps; p [m] is relative to the eye, along world axes
    /// [1] Scale of the placement: a length in the world divided by the same length in the group.
    float scale = 1;
    /// [1] Factor of the eroded extinction, by which its integral equals that of the smooth extinction.
    float factor = 1;
};

/// [1] Symbol v of formula field-detail, for a single ball.
/// @param crossSection [m2] in the world  @param radius [m] in the world
float thinningOf(const GroupDetail& detail, float crossSection, float radius);

/// Reads the group of the kind "material" that follows a group of blobs.
class BlobDetail
{
public:
    BlobDetail() = default; ///< has no detail
    /// @param group index of the group of blobs in the newer snapshot
    /// @param t moment between the snapshots: 0 is the older snapshot, 1 the newer
    BlobDetail(const base::SnapshotPair& snapshots, size_t group, float t);

    bool isGiven() const { return chosen_ != nullptr; }
    /// The parameters of the detail at the moment.
    /// @param place placement of the group at the moment, relative to the eye
    GroupDetail groupDetail(const base::Placement& place) const;
    /// Offset of a blob's noise coordinates [cell], for each generation.
    /// @param newer, older indices of the blob in the newer and in the older group; `older` is used only if
    ///         hasOlder
    /// @param position [m] position of the blob at the shown time, in the space of the group
    std::array<glm::vec3, 2> carried(size_t newer, size_t older, bool hasOlder,
                                     const glm::vec3& position) const;

private:
    const base::SnapshotGroup* newer_ = nullptr;
    /// The snapshot group whose generations of coordinates are used at the moment.
    const base::SnapshotGroup* chosen_ = nullptr;
    FieldDetailNumbers numbers_;
};

} // namespace fx::render
