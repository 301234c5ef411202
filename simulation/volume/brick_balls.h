/// @file brick_balls.h
/// Publishes a medium on voxels: the balls that stand for its bricks, and the place of the voxels.
#pragma once

#include "foundation/assets/voxel_volume.h"
#include "foundation/snapshot/volume_kind.h"
#include "simulation/detail/field_detail.h"
#include "simulation/solver/still_medium.h"

#include <glm/geometric.hpp>

#include <span>

namespace fx::sim {

/// Place of the voxels of a medium in the space of the effect.
struct BrickPlace
{
    glm::vec3 origin{0.0f}; ///< [m] center of the voxel (0, 0, 0)
    float side = 1.0f;      ///< [m]

    BrickPlace(const StillMediumDef& def, const glm::vec3& ownOrigin, float ownSide)
        : origin(def.position + def.scale * ownOrigin), side(def.scale * ownSide)
    {}

    /// [m] Center of the cells of a brick.
    glm::vec3 centerOf(const glm::ivec3& brick) const
    {
        return origin + side * float(base::kVolumeBrickSide) * (glm::vec3(brick) + 0.5f);
    }
    /// [m] Upper bound of the distance of the ball of a brick from the origin of the effect.
    float reachOf(const glm::ivec3& brick) const
    {
        return (glm::length(centerOf(brick)) + base::kVolumeBallRadius * side) * 1.0001f; // above rounding
    }
};

/// The kinds of a volume; kNoKind if a snapshot does not have them.
struct VolumeKinds
{
    base::KindId blobs, volumes, materials;

    explicit VolumeKinds(const base::SnapshotSchema& schema);
};

/// [byte] In all snapshots of a scene, of each ball of a volume with detail.
constexpr uint64_t kBrickMaterialBytes = 3 * 32;

struct BrickBalls
{
    const StillMediumDef& def;
    BrickPlace place;
    std::span<const base::VolumeCells> cells; ///< may be empty
    uint32_t capacity;                        ///< most cells at any time
    uint32_t asset;                           ///< id in the asset table
    const FieldDetail& detail;                ///< its coordinates are places in the volume
    float frame = 0.0f, frameBefore = 0.0f;   ///< see volume_constant
    float frameSeconds = 0.0f;                ///< [s]
    uint32_t lattice = 0;                     ///< see volume_constant
    bool loops = false;                       ///< see volume_constant
    float detailSide = 0.0f;                  ///< [m] of voxels for which detail is; 0: of `place`

    /// Adds a group of balls, their noise coordinates if there is detail, and one of the volume, each if its
    /// kind is known. A brick has its own id on each lattice.
    void publish(const base::GroupInfo& base, const VolumeKinds& kinds, base::FrameSnapshot& snapshot) const;

private:
    void addCoordinates(base::KindId kind, base::FrameSnapshot& snapshot) const;
};

} // namespace fx::sim
