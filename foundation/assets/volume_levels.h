/// @file volume_levels.h
/// A volume at coarser resolutions, in the layout in which OpenGL reads voxels.
#pragma once

#include "foundation/assets/voxel_volume.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace fx::base {

/// The coarsest level: voxels of 2^16 times the side. At level 10 the widest volume is two voxels wide.
constexpr int kMostVolumeLevel = 16;

/// The voxels of a volume at one resolution.
struct VolumeLevel
{
    /// A voxel in the layout of shaders/field/field_volume.comp.glsl, see render::MediumVolume::packed().
    using Packed = std::array<uint32_t, 4>;

    BrickIndex index;
    uint32_t bricks = 0;
    float brightest = 1.0f;     ///< [cd/m3] in units of which light is packed
    std::vector<Packed> voxels; ///< see render::MediumVolume::packedWithVelocities()
};

/// Levels 1 to kMostVolumeLevel of a volume.
struct VolumeLevels
{
    std::vector<VolumeLevel> coarser; ///< level 1 first

    uint64_t bytes() const; ///< [byte] size of all arrays
};

using CoarserLevels = std::shared_ptr<const VolumeLevels>;

} // namespace fx::base
