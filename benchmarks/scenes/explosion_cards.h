/// @file explosion_cards.h
/// The gas of the library's explosion as cards.
#pragma once

#include "benchmarks/scenes/cards.h"
#include "foundation/result/status.h"

namespace fx::cli {

/// 800 particles of gas at `seconds` after the start, 12 m before the eye, their middle 4 m above the ground
/// in the middle of the field. Each glows by its temperature, and sends a random gray share of its albedo:
/// bright and dark balls stand side by side, at a mean optical depth of about 18.
/// @return NotFound when the library has no explosion of gas
base::Result<std::vector<Card>> explosionCards(double seconds);

constexpr float kExplosionField = 10.0f; ///< [m] that the width of a picture of them shows

} // namespace fx::cli
