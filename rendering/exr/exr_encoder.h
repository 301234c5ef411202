/// @file exr_encoder.h
/// Images with named channels as the bytes of an OpenEXR file (scan lines, ZIP). Write only.
///
/// The bytes are made in memory, so that the caller can put them in place whole or not at all.
/// Threads: any; one call uses up to `threads` workers of OpenEXR's own pool. The bytes do not depend on
/// their number.
#pragma once

#include "foundation/result/status.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace fx::render {

enum class ExrPrecision
{
    Half,  ///< 16 bits, relative error 2^-11; finite values outside its range are written as +-65504
    Float, ///< 32 bits, exact
    Whole, ///< 32 bits, whole numbers from 0 to 2^24; others are rounded, or cut to these
};

/// One channel: `values[(row * width + column) * stride + offset]`, rows from the top.
struct ExrChannel
{
    std::string name; ///< "R", or "layer.R"; unique in the image, not empty, at most 255 bytes
    std::span<const float> values;
    size_t offset = 0; ///< [float] of the first value
    size_t stride = 1; ///< [float] from pixel to pixel, >= 1
    ExrPrecision precision = ExrPrecision::Half;
};

struct ExrImage
{
    int width = 0;  ///< [pixel] 1..16384
    int height = 0; ///< [pixel] 1..16384
    std::vector<ExrChannel> channels;
    float whiteLuminance = 0.0f; ///< [cd/m2] of the value 1; 0 when unknown
};

/// Channels R, G, B, A of an interleaved RGBA image; `layer` is put before the names ("fire" gives "fire.R").
void addRgba(ExrImage& image, const std::string& layer, std::span<const float> rgba, ExrPrecision precision);

/// A single channel of an image with one value a pixel.
void addPlane(ExrImage& image, const std::string& name, std::span<const float> values,
              ExrPrecision precision);

/// The file. Primaries are written as Rec. 709. NaN and infinities are kept.
/// @param threads maximum number of threads; 0: all hardware threads
/// @return InvalidArgument (size, a channel that is too short, a repeated name), OutOfMemory, Internal
base::Result<std::string> encodeExr(const ExrImage& image, uint32_t threads = 0);

} // namespace fx::render
