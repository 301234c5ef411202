/// @file png_reader.h
/// Decodes PNG files (W3C PNG, second edition) to eight bits a channel. The decoder is the header stb_image;
/// libfxsdk needs no further library. This reader checks sizes, checksums and the palette, because stb_image
/// does not check them.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <span>
#include <vector>

namespace fx::asset {

/// Texels as stored, without color conversion; rows from the top; red, green, blue and opacity.
struct PngPicture
{
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgba;
};

/// Decodes every color type, bit depth and interlacing of the standard; 16 bits are rounded to 8. Color
/// profiles and gamma chunks are ignored. Sizes are checked before decoding. Indices beyond the end of the
/// palette are black.
/// @return TooLarge (more than 8192 texels a side, or more texels than the bytes can contain), Parse with
/// the reason
base::Result<PngPicture> readPng(std::span<const uint8_t> file);

} // namespace fx::asset
