/// @file volume_levels.h
/// Prepares volumes for OpenGL, on the threads that read them.
#pragma once

#include "foundation/assets/volume_levels.h"
#include "rendering/volumes/medium_volume.h"

#include <cstdint>

namespace fx::render {

/// The voxels of a medium in the layout of the GPU.
base::VolumeLevel packedLevel(const MediumVolume& medium);

/// All coarser levels of a volume, each by MediumVolume::halved() from the one before. Threads: any.
base::CoarserLevels coarserLevels(const base::VoxelVolume& volume);

/// [byte] Upper bound of VolumeLevels::bytes() of coarserLevels(), from the bricks of the volume alone.
uint64_t mostCoarserBytes(std::vector<glm::ivec3> bricks, bool hasVelocities);

} // namespace fx::render
