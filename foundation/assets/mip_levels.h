/// @file mip_levels.h
/// Mip levels of images. Colors are averaged as linear light, not as sRGB codes, and weighted by opacity.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fx::base {

/// Number of mip levels of a picture of that size, down to one texel.
int mipLevelCount(int width, int height);

/// Computes the next smaller level: side lengths are halved, rounded down, at least 1; each texel is the mean
/// of the texels that it covers.
/// @param rgba width * height * 4 bytes @param isSrgb color is averaged in light, weighted by opacity;
///         otherwise all four channels are averaged without conversion
void halveImage(std::span<const uint8_t> rgba, int width, int height, bool isSrgb, std::vector<uint8_t>& out);

} // namespace fx::base
