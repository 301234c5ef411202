/// @file cards.h
/// Isolated and overlapping blobs for the comparison of billboards.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace fx::cli {

/// A blob in front of the eye. The coordinate z is the parameter of the rays, starting at the near plane.
struct Card
{
    float x, y, z;      ///< [m]
    float radius;       ///< [m]
    float crossSection; ///< [m2]
    std::array<float, 3> emission;
};

/// A grid of blobs that fills the field of 2.4 m by 1.5 m without overlaps. The optical depth through the
/// center of each blob is 2.
std::vector<Card> isolatedCards(uint32_t count);

/// Blobs distributed evenly in a ball of radius 1 m, flattened to the field. The optical depth through the
/// center is 4 to 6.
std::vector<Card> overlappingCards(uint32_t count);

} // namespace fx::cli
