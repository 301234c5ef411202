/// @file ground_lanes.h
/// ground-bounce for the rows of a tile, once for each instruction set.
#pragma once

#include "simulation/motion/ground_contact.h"
#include "simulation/particles/tile.h"

namespace fx::sim {

/// Reflects the rows that have gone below the ground, neither Empty nor Stuck, and marks them Hit and
/// Collided: the same bits as bounce() for each.
void bounceTile(const GroundContact& ground, Tile& tile);

} // namespace fx::sim
