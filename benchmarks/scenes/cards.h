/// @file cards.h
/// Blobs for the comparison of billboards, alone and overlapping.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace fx::cli {

/// A blob in front of the picture. Ray parameters are z, from the near plane on.
struct Card
{
    float x, y, z;      ///< [m]
    float radius;       ///< [m]
    float crossSection; ///< [m2]
    std::array<float, 3> emission;
};

/// A grid that fills the field of 2.4 m by 1.5 m, no two blobs in one another's way; optical depth 2 through
/// the middle of each.
std::vector<Card> isolatedCards(uint32_t count);

/// Even in a ball of radius 1, flattened to the field; optical depth 4 to 6 through the middle.
std::vector<Card> overlappingCards(uint32_t count);

} // namespace fx::cli
