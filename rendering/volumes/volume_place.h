/// @file volume_place.h
/// Volumes of a snapshot: which groups have one, and where it is.
#pragma once

#include "foundation/assets/volume_sequence.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/volumes/medium_volume.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::render {

/// The volume of a group of blobs at its interpolated placement.
struct GroupVolume
{
    uint32_t asset = 0; ///< id in the asset table
    double frame = 0.0; ///< [1] frame that is shown, if the asset is a sequence, see volume_constant::Frame
    bool loops = false; ///< after the last frame follows the first one
    double frameSeconds = 0.0; ///< [s] from a frame to the next; 0: the asset is a single volume
    uint32_t lattice = 0;      ///< frame of a sequence whose lattice the voxels below have
    /// From a place p [m] in the axes of the world to voxels: toVoxels p + first. p is relative to the origin
    /// of the placement's position.
    glm::dmat3 toVoxels{1.0};
    glm::dvec3 first{0.0};  ///< [voxel]
    double side = 1.0;      ///< [m] side of a voxel in the world
    double density = 1.0;   ///< [1] factor of the extinction and emission of the file, per meter of the world
    bool isAligned = true;  ///< true: the axes of the voxels are those of the world
    glm::vec3 tint{1.0f};   ///< [1] factor of albedo and emission of the file
    float fireShare = 0.0f; ///< [1] of the first blob
    float anisotropy = 0.0f;
    uint32_t layer = 0; ///< MediaLayer

    glm::dvec3 voxelAt(const glm::dvec3& p) const { return toVoxels * p + first; }
    /// Place of the center of the voxel (0, 0, 0).
    glm::dvec3 origin() const;
};

/// The group of the kind "volume" that belongs to the group of blobs `group`; null: there is none.
const base::SnapshotGroup* volumeGroup(const base::FrameSnapshot& snapshot, size_t group);

/// @param blobs group of blobs to which `volume` belongs
/// @param place, t placement, and the moment between the older (0) and the newer (1) snapshot
GroupVolume groupVolume(const base::SnapshotGroup& blobs, const base::SnapshotGroup& volume,
                        const base::Placement& place, double t);

/// The frames between which a moment of a sequence is.
struct FramePair
{
    uint32_t first = 0, second = 0;
    double part = 0.0; ///< [1] 0: the first frame, 1: the second
};
/// @param count number of frames of the sequence, > 0
FramePair framePair(const GroupVolume& volume, uint32_t count);

/// The moment of a sequence, on the lattice of the volume.
MediumVolume::Moment momentOf(const GroupVolume& volume, const FramePair& pair,
                              const base::VolumeSequence& sequence);

} // namespace fx::render
