/// @file mip_levels.h
/// Mip levels of images. Colors are averaged as linear light, not as sRGB codes, and weighted by opacity.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fx::base {

/// Number of mip levels of an image of `width` x `height` texels, down to one texel.
int mipLevelCount(int width, int height);

/// Computes the next smaller level: side lengths are halved, rounded down, at least 1; each texel is the mean
/// of the texels that it covers.
/// @param rgba width * height * 4 bytes
/// @param isSrgb true: colors are averaged as linear light, weighted by opacity; false: all four channels are
///         averaged without conversion
void halveImage(std::span<const uint8_t> rgba, int width, int height, bool isSrgb, std::vector<uint8_t>& out);

} // namespace fx::base
