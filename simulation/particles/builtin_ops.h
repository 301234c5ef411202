/// @file builtin_ops.h
/// The modules that every emitter may have: the members of EmitterForces.
#pragma once

#include "simulation/motion/ground_contact.h"
#include "simulation/particles/emitter_settings.h"
#include "simulation/particles/tile.h"

#include <memory>
#include <vector>

namespace fx::sim {

/// Appends those that `def` needs, in the order in which they run.
void addBuiltinOps(const EmitterSettings& def, std::vector<std::shared_ptr<const TileOp>>& ops);

/// Reflects the rows that have gone below the ground, neither Empty nor Stuck, and marks them Hit and
/// Collided: the same bits as bounce() for each.
void bounceTile(const GroundContact& ground, Tile& tile);

} // namespace fx::sim
