/// @file picture.h
/// A picture in memory between reading from the GPU and writing to a file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace fx::cli {

/// A picture. Rows are stored from the top; channels are interleaved.
struct Picture
{
    int width = 0;    ///< [pixel]
    int height = 0;   ///< [pixel]
    int channels = 0; ///< 1..4
    std::vector<float> pixels;
};

/// Converts pixels from the row order of GL, bottom row first.
inline Picture fromBottomUp(int width, int height, int channels, std::vector<float> pixels)
{
    const size_t row = size_t(width) * size_t(channels);
    for (size_t low = 0, high = size_t(height) - 1; low < high; ++low, --high)
        std::swap_ranges(pixels.begin() + std::ptrdiff_t(low * row),
                         pixels.begin() + std::ptrdiff_t((low + 1) * row),
                         pixels.begin() + std::ptrdiff_t(high * row));
    return {width, height, channels, std::move(pixels)};
}

} // namespace fx::cli
