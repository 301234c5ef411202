/// @file image.h
/// Pictures in memory, and functions for PNG and Radiance files. Tools and readers of scene files use these
/// functions. libfxsdk itself reads no images.
#pragma once

#include "foundation/result/status.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fx::image {

/// A picture. The top row comes first; channels are interleaved.
struct Image
{
    int width = 0;    ///< [pixel]
    int height = 0;   ///< [pixel]
    int channels = 0; ///< number of channels: 3 for RGB, 4 for RGBA
    std::vector<float> pixels;

    float* at(int x, int y)
    {
        return pixels.data() + (size_t(y) * size_t(width) + size_t(x)) * size_t(channels);
    }
    const float* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
};

constexpr int kLargestSide = 16384;                ///< [pixel]
constexpr uint64_t kMaxPixels = uint64_t(1) << 25; ///< width times height

/// Decodes a PNG of 8 or 16 bits as sRGB to linear values in [0, 1]. Alpha is linear and not premultiplied.
/// Before decoding, width and height are compared with the limits and with the number of bytes.
/// @return TooLarge, Parse
base::Result<Image> readPng(std::span<const std::byte> bytes);

/// Decodes a Radiance picture (RGBE, flat or run-length encoded) to RGB values, without conversion.
/// @return TooLarge, Parse
base::Result<Image> readHdr(std::span<const std::byte> bytes);

/// Encodes display-referred values as an 8-bit PNG. The values must already be sRGB-encoded. They are
/// clamped to [0, 1] and rounded; NaN becomes 0.
/// @return InvalidArgument for sizes or numbers of channels that PNG does not support
base::Result<std::vector<std::byte>> writePng(const Image& image);

/// Transfer functions of sRGB (IEC 61966-2-1). Arguments and results are in [0, 1].
float srgbToLinear(float encoded);
float linearToSrgb(float linear);

} // namespace fx::image
