/// @file png_reader.h
/// PNG files (W3C PNG, second edition) to eight bits a channel. stb_image unpacks them; it is a header, so
/// libfxsdk needs no other library. What it leaves out is checked here: sizes, check sums, the palette.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <span>
#include <vector>

namespace fx::asset {

/// Texels as they are in the file, rows from the top, red, green, blue and opacity.
struct PngPicture
{
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgba;
};

/// Every color type, depth and interlacing of the standard; 16 bits are rounded to 8. Color profiles and
/// gamma chunks are not looked at. Sizes are checked before anything is unpacked, and unpacking takes no
/// more memory than they call for. Colors that a palette lacks are black.
/// @return TooLarge (more than 8192 texels a side, or than the bytes can hold), Parse with the reason
base::Result<PngPicture> readPng(std::span<const uint8_t> file);

} // namespace fx::asset
