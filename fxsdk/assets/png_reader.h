/// @file png_reader.h
/// PNG files (W3C PNG, second edition) to eight bits a channel. stb_image decodes them; it is a header, so
/// libfxsdk needs no further library. Sizes, check sums and the palette, which stb_image does not check, are
/// checked here.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <span>
#include <vector>

namespace fx::asset {

/// Texels without conversion, rows from the top, red, green, blue and opacity.
struct PngPicture
{
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgba;
};

/// Every color type, depth and interlacing of the standard; 16 bits are rounded to 8. Color profiles and
/// gamma chunks are ignored. Sizes are checked before decoding, which takes no more memory than they require.
/// Colors that a palette lacks are black.
/// @return TooLarge (more than 8192 texels a side, or than the bytes can contain), Parse with the reason
base::Result<PngPicture> readPng(std::span<const uint8_t> file);

} // namespace fx::asset
