/// @file dazzle_image.h
/// Any flat OpenEXR picture as planes of floats, read with limits that are checked before memory is taken.
#pragma once

#include "foundation/result/status.h"

#include <string>
#include <vector>

namespace fx::cli {

struct DazzlePlane
{
    std::string name;          ///< "R", "fire.G", "depth.Z"
    bool isHalf = false;       ///< in the file
    std::vector<float> values; ///< rows from the top
};

struct DazzleImage
{
    int width = 0;
    int height = 0;
    std::vector<DazzlePlane> planes;
    std::vector<std::string> leftOut; ///< channels of whole numbers, which are no light
    float whiteLuminance = 0;         ///< [cd/m2] of the value 1; 0 when the file does not state it
};

/// The first part of the file, scan lines or tiles, its data window alone. At most 16384 pixels a side, 2^25
/// in all, 256 channels, 2^29 values, and 10,000 bytes of picture for one of the file.
/// @return Io, Parse (also deep or subsampled pixels), TooLarge, OutOfMemory, naming the file
base::Result<DazzleImage> readDazzleImage(const std::string& path);

} // namespace fx::cli
