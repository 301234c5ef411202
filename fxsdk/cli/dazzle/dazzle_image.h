/// @file dazzle_image.h
/// Reads any flat OpenEXR picture as planes of floats. Limits are checked before memory is allocated.
#pragma once

#include "foundation/result/status.h"

#include <string>
#include <vector>

namespace fx::cli {

struct DazzlePlane
{
    std::string name;          ///< name of the channel, such as "R", "fire.G", "depth.Z"
    bool isHalf = false;       ///< true if the file stores half floats
    std::vector<float> values; ///< rows from the top
};

struct DazzleImage
{
    int width = 0;
    int height = 0;
    std::vector<DazzlePlane> planes;
    std::vector<std::string> leftOut; ///< names of skipped channels: integer channels do not contain light
    float whiteLuminance = 0;         ///< [cd/m2] luminance of the value 1; 0 if the file does not state it
};

/// Reads the data window of the first part of the file. The part may be stored as scan lines or tiles.
/// Limits: 16384 pixels a side, 2^25 pixels, 256 channels, 2^29 values, and 10,000 bytes of picture for each
/// byte of the file.
/// @return Io, Parse (also for deep or subsampled pixels), TooLarge, OutOfMemory; the message names the
///         file
base::Result<DazzleImage> readDazzleImage(const std::string& path);

} // namespace fx::cli
