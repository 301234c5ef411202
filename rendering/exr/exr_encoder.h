/// @file exr_encoder.h
/// Encodes images with named channels as OpenEXR files (scan lines, ZIP).
///
/// The file is encoded in memory, so that the caller can write it completely or not at all. Threads: any. A
/// call uses up to `threads` worker threads of OpenEXR's thread pool. The encoded bytes do not depend on the
/// number of workers.
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
    Half,  ///< 16 bits, relative error 2^-11; larger finite values are clamped to +-65504
    Float, ///< 32 bits, exact
    Whole, ///< 32 bits, integers from 0 to 2^24; values are rounded and clamped
};

/// One channel of the image. The value of a pixel is `values[(row * width + column) * stride + offset]`. Row
/// 0 is the top row.
struct ExrChannel
{
    /// Name of the channel, such as "R" or "layer.R"; unique in the image, not empty, at most 255 bytes.
    std::string name;
    std::span<const float> values;
    size_t offset = 0; ///< [float] index in `values` of the first value of the channel
    size_t stride = 1; ///< [float] distance in `values` of neighboring pixels, >= 1
    ExrPrecision precision = ExrPrecision::Half;
};

struct ExrImage
{
    int width = 0;  ///< [pixel] 1..16384
    int height = 0; ///< [pixel] 1..16384
    std::vector<ExrChannel> channels;
    float whiteLuminance = 0.0f; ///< [cd/m2] luminance of a pixel with the value 1; 0 if unknown
};

/// Adds channels R, G, B, A of an interleaved RGBA image. `layer` is the prefix of their names ("fire" gives
/// "fire.R").
void addRgba(ExrImage& image, const std::string& layer, std::span<const float> rgba, ExrPrecision precision);

/// Adds one channel from an image with one value per pixel.
void addPlane(ExrImage& image, const std::string& name, std::span<const float> values,
              ExrPrecision precision);

/// Returns the bytes of the file. The file declares Rec. 709 primaries. NaN and infinities are kept.
/// @param threads maximum number of threads; 0: all hardware threads
/// @return InvalidArgument (size, a channel that is too short, a repeated name), OutOfMemory, Internal
base::Result<std::string> encodeExr(const ExrImage& image, uint32_t threads = 0);

} // namespace fx::render
