/// @file volume_file.h
/// Files of media on sparse voxels (`*.fxvolume`), which `fx import --bricks` writes.
///
/// A file is a text header followed by binary numbers, little endian. Lines of the header:
///
/// - `fxvolume 1`
/// - `bricks N`: 1..2^15
/// - `side S`: [m] of a voxel, 1e-6 to 1e6
/// - `origin X Y Z`: [m] center of the voxel (0, 0, 0), within 1e6
/// - `albedo R G B`: of the medium if it has no channel of this name, 0..1
/// - `extinction M`: [1/m] largest value of the channel, as in the next five lines; at most 1e12
/// - `temperature M`: [K] at most 1e5; this line and the next four may be absent
/// - `emission M`: [cd/m3] at most 1e12
/// - `emission_rates M`: [1/s] largest absolute value, at most 4096; values have a sign
/// - `albedos M`: [1] at most 1
/// - `velocities M`: [m/s] largest absolute value of a component, at most 1e9; values have a sign
/// - `hash H`: up to 16 hexadecimal digits, of the lines above and of the bytes behind the header
/// - `data`
///
/// Behind the header are 3 * N 16-bit integers, the coordinates x y z of the bricks in the order of
/// VoxelVolume. Then come 512 half floats for each brick and component, for each channel of the header in
/// its order: values over the largest. The components of a color follow each other. A voxel without
/// extinction emits nothing; its velocity is that of the medium around it.
///
/// The lines of the header have this order. Each ends with a line feed; single spaces separate their words.
#pragma once

#include "foundation/assets/voxel_volume.h"
#include "foundation/result/status.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace fx::asset {

/// [byte] maximum size of a file: twelve components of all bricks, their coordinates, and the header
constexpr uint64_t kMaxVolumeFileBytes =
    uint64_t(base::kMaxVolumeBricks) * (12 * base::kVolumeBrickVoxels * 2 + 6) + 1024;

/// Reads a file. Sizes are compared with the number of bytes before memory is allocated.
/// @return Parse with the line or the place, Version, TooLarge, InvalidArgument for numbers out of range
base::Result<base::VoxelVolume> parseVolume(std::string_view bytes);

/// The file of a volume. Values are rounded to half floats over the largest of their channel: to 11 bits down
/// to 6e-5 of the largest.
/// @return TooLarge, InvalidArgument with the number that is out of range and the remedy
base::Result<std::string> writeVolume(const base::VoxelVolume& volume);

/// The hash that a file states.
/// @param header lines before that of the hash  @param data bytes behind the header
uint64_t volumeHash(std::string_view header, std::string_view data);

} // namespace fx::asset
