/// @file dazzle_levels.h
/// The published glare algorithm for 8-bit pictures, and a corrected version of the algorithm.
///
/// A channel of a picture is a list of levels. Levels 0..255 can be displayed; higher levels overflow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fx::render {

/// @formula dazzle-levels
/// Distributes the overflow of an 8-bit picture to levels below white, in proportion to their headroom.
///
/// symbol   unit    meaning
///   i      level   0..255
///   c_i    1       number of pixels of level i
///   over   level   sum of p - 255 over pixels above 255
///   glare  level   distributed amount: over times the sensor's gain, at most S_0
///   S_i    level   headroom of all pixels of level i and above, sum over j >= i of c_j (255 - j)
/// @derivation
///   The exact share of a pixel of level i is glare (255 - i) / S_0. From the brightest level down, level i
///   gets
///       q_i = floor(glare S_i / S_0) - floor(glare S_(i+1) / S_0)                               (1)
///   so that the sum of all q_i is exactly glare. Each pixel of the level gets floor(q_i / c_i). The rest is
///   spread evenly: pixel n of the level, in the order of the picture, gets one more if
///       floor((n + 1) rest / c_i) > floor(n rest / c_i)                                         (2)
///   Since glare <= S_0, q_i <= c_i (255 - i): no pixel exceeds 255, and no pixel gets darker.
/// @source    [UBT96] dazzle of the CCD sensor
/// @deviation the published code divides by zero below the darkest level in use, counts overflowed pixels in
///            its histogram and overflows 32 bits. It also rounds up whole levels, so that it distributes too
///            much and may darken the remaining levels. (1) and (2) have none of these faults
/// @valid     any levels, sums up to 2^63; without headroom nothing is distributed; with glare = S_0 every
///            pixel becomes 255
/// @accuracy  integers, no rounding error of sums; each pixel is within 2 levels of its exact share
/// @tests     tests/rendering/reference/dazzle/test_dazzle_levels.cpp
/// @param gain glare per overflow, >= 0; with 1 the whole overflow is distributed
std::vector<uint8_t> dazzleLevels(std::span<const uint32_t> levels, double gain);

/// Runs the published algorithm with one change: the function stops instead of dividing by zero. Tests use
/// the result for comparison.
std::vector<int64_t> dazzleLevelsAsPrinted(std::span<const uint32_t> levels);

} // namespace fx::render
