/// @file mip_levels.h
/// Smaller and smaller copies of a picture, so that it is seen from afar as it is: light is averaged, not
/// codes, and transparent texels lend no color.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fx::base {

/// How many levels a picture of that size has, down to one texel.
int mipLevelCount(int width, int height);

/// One level smaller: sides are halved, rounded down, at least 1; each texel is the mean of those it covers.
/// @param rgba width * height * 4 bytes  @param isSrgb color is averaged in light, weighted by opacity;
/// otherwise all four channels are averaged as they are
void halveImage(std::span<const uint8_t> rgba, int width, int height, bool isSrgb, std::vector<uint8_t>& out);

} // namespace fx::base
