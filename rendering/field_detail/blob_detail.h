/// @file blob_detail.h
/// The detail of a group of blobs at a moment between two snapshots, relative to the eye.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/field_detail/field_detail_numbers.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace fx::render {

/// Detail of all blobs of a group.
struct GroupDetail
{
    FieldDetailNumbers numbers; ///< lengths in the space of the group
    glm::mat3
        /// Coordinates in cells of the generations, without the offsets of blobs: toCells p + first.
        toCells[2];
    glm::vec3 first[2]; ///< [cell] p in m relative to the eye, world axes
    float scale = 1;    ///< [1] metres of the world over those of the group
    float factor = 1;   ///< [1] multiplies the eroded extinction, so that its integral is preserved
};

/// [1] v of field-detail of a ball by itself.
/// @param crossSection [m2], radius [m] in the world
float thinningOf(const GroupDetail& detail, float crossSection, float radius);

/// Reads the group of the kind "material" that follows a group of blobs.
class BlobDetail
{
public:
    BlobDetail() = default; ///< none
    /// @param group number of the group of blobs in the newer snapshot  @param t moment, 0 older .. 1 newer
    BlobDetail(const base::SnapshotPair& snapshots, size_t group, float t);

    bool isGiven() const { return chosen_ != nullptr; }
    /// @param place of the group at the moment, relative to the eye
    GroupDetail groupDetail(const base::Placement& place) const;
    /// Offset of a blob in noise space, in cells.
    /// @param newer, older number of the blob in its group of blobs; older is not used when !hasOlder
    /// @param position [m] of the blob at the shown time, in the space of the group
    std::array<glm::vec3, 2> carried(size_t newer, size_t older, bool hasOlder,
                                     const glm::vec3& position) const;

private:
    const base::SnapshotGroup* newer_ = nullptr;
    const base::SnapshotGroup* chosen_ = nullptr; ///< whose generations live at the moment
    FieldDetailNumbers numbers_;
};

} // namespace fx::render
