/// @file dazzle_levels.h
/// The published algorithm of glare for 8-bit pictures, and a corrected version.
///
/// One channel of a picture is a list of levels: 0..255 can be displayed, higher levels overflow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fx::render {

/// @formula dazzle-levels
/// Overflow of an 8-bit picture dealt to the levels below white in proportion to their headroom.
///
/// symbol   unit    meaning
///   i      level   0..255
///   c_i    1       number of pixels of level i
///   over   level   sum of p - 255 over pixels above 255
///   glare  level   what is dealt: over times the sensor's gain, at most S_0
///   S_i    level   headroom of all pixels of level i and above, sum over j >= i of c_j (255 - j)
/// @derivation
///   Each pixel of level i is due glare (255 - i) / S_0. Levels are dealt from the brightest down; level i
///   gets
///       q_i = floor(glare S_i / S_0) - floor(glare S_(i+1) / S_0)                               (1)
///   so that the q_i sum to glare exactly. Its pixels get floor(q_i / c_i), and the rest is spread evenly:
///   pixel n of the level, in the order of the picture, gets one more where
///       floor((n + 1) rest / c_i) > floor(n rest / c_i)                                         (2)
///   glare <= S_0 gives q_i <= c_i (255 - i): no pixel exceeds 255, and none gets darker.
/// @source    [UBT96] dazzle of the CCD sensor
/// @deviation the published code divides by zero below the darkest level in use, counts overflowed pixels in
///            its histogram, overflows 32 bits, and rounds a whole level up at once, which overspends, up to
///            darkening what is left; (1) and (2) do none of it
/// @valid     any levels, sums up to 2^63; no headroom leaves nothing to deal; glare beyond S_0 fills every
/// pixel
/// @accuracy  exact: integers; each pixel is less than 2 levels from its real share
/// @tests     tests/rendering/reference/dazzle/test_dazzle_levels.cpp
/// @param gain glare per overflow, >= 0; 1 deals all of it
std::vector<uint8_t> dazzleLevels(std::span<const uint32_t> levels, double gain);

/// The published code with one change: it stops instead of dividing by zero. Kept for comparison.
std::vector<int64_t> dazzleLevelsAsPrinted(std::span<const uint32_t> levels);

} // namespace fx::render
