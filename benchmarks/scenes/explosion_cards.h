/// @file explosion_cards.h
/// The gas of the library's explosion as blobs (Card).
#pragma once

#include "benchmarks/scenes/cards.h"
#include "foundation/result/status.h"

namespace fx::cli {

/// 800 particles of gas at `seconds` after the start, 12 m in front of the eye. The center of the particles
/// is 4 m above the ground, in the middle of the field. Each particle glows by its temperature. Its albedo is
/// multiplied by a random gray factor, so that bright and dark balls are adjacent. The mean optical depth is
/// about 18.
/// @return NotFound when the library was built without gases
base::Result<std::vector<Card>> explosionCards(double seconds);

constexpr float kExplosionField = 10.0f; ///< [m] width of the scene in a picture

} // namespace fx::cli
