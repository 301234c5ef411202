/// @file voxel_texture.h
/// The voxels of a volume as texels. A shader reads a buffer only up to the size that the driver states,
/// which may be as little as 16 MiB; a texture of three dimensions has 2048 texels along each side with every
/// driver.
#pragma once

#include "foundation/assets/volume_levels.h"
#include "rendering/gl/gl_texture.h"

#include <cstdint>
#include <span>

namespace fx::render {

/// Creates a texture of three dimensions that holds a list: element i is texel (i % 512, i / 512 % 512, i /
/// 512^2). Threads: [GL thread].
/// @param list not empty
/// @param label a string literal
/// @return OutOfMemory; InvalidArgument for more layers than limits().volumeSize, which no level of a volume
/// has
base::Result<GlTexture> makeVoxelTexture(GlDevice& device, std::span<const base::VolumeLevel::Packed> list,
                                         const char* label);

} // namespace fx::render
