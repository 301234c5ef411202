/// @file volume_kind.h
/// The kind "volume": a medium on sparse voxels (foundation/assets/voxel_volume.h). Techniques that publish
/// volumes and passes that draw them include this header; the snapshot container does not.
///
/// A group of this kind has no elements. It follows a group of the kind "blob" of the same solver, and that
/// of the kind "material" if the volume has detail. The group of blobs has one ball for each brick whose
/// cells contain medium: up to eight for a stored brick, see VolumeCells. The ball has the cross section of
/// the cells, is concentric with the brick, and contains the brick. Readers that know this kind replace the
/// balls by the voxels. Other readers, and compositions without voxels, use the balls. The balls of a
/// sequence are those of all frames that are shown between the previous snapshot and this one, on the lattice
/// of one of them; their cross sections are interpolated between the frames, and may be as good as 0.
#pragma once

#include "foundation/snapshot/snapshot_schema.h"

namespace fx::base {

/// Indices of the constants of a group.
namespace volume_constant {
enum : size_t
{
    Asset,   ///< id of the volume in the asset table
    OriginX, ///< [m] center of the voxel (0, 0, 0), in the local space of the group
    OriginY,
    OriginZ,
    Side,    ///< [m] side of a voxel, along the axes of the local space
    Density, ///< [1] factor of the extinction and of the emission, per length of the local space
    /// [1] Of a sequence: frame that is shown, from 0; a fraction leads from one frame to the next. From the
    /// number of frames on, the sequence has begun again if it loops; above the last frame, another one
    /// shows that frame. Below 0, which is before the start of the instance, the first frame is shown.
    Frame,
    FrameBefore,  ///< [1] the same at the previous snapshot, at most `Frame`
    FrameSeconds, ///< [s] from a frame to the next; 0: the asset is a single volume
    Lattice,      ///< [1] of a sequence: the frame whose voxels have this origin and side
    Loops,        ///< [1] of a sequence: 1 if the first frame follows the last one, otherwise 0
    Count
};
}

/// [1] Radius of a ball over the side of a voxel. The ball contains its brick: half of the brick's diagonal
/// is 6.93 voxels. The extinction of the ball is above 0 at the corners of the brick.
constexpr float kVolumeBallRadius = 8.0f;
/// [1] Radius of the ball within the brick that casts the brick's shadow, over the side of a voxel.
constexpr float kVolumeCasterRadius = 4.0f;

inline constexpr ColumnDesc kVolumeConstants[volume_constant::Count] = {
    {"asset", "1"},        {"originX", "m"}, {"originY", "m"}, {"originZ", "m"},
    {"side", "m"},         {"density", "1"}, {"frame", "1"},   {"frameBefore", "1"},
    {"frameSeconds", "s"}, {"lattice", "1"}, {"loops", "1"},
};

inline constexpr KindDesc kVolumeKind{"volume", {}, kVolumeConstants, false};

} // namespace fx::base
