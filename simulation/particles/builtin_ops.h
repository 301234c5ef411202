/// @file builtin_ops.h
/// The built-in modules of emitters, controlled by the members of EmitterForces.
#pragma once

#include "simulation/motion/ground_contact.h"
#include "simulation/particles/emitter_settings.h"
#include "simulation/particles/tile.h"

#include <memory>
#include <vector>

namespace fx::sim {

/// Appends the built-in modules that `def` needs, in the order of execution.
void addBuiltinOps(const EmitterSettings& def, std::vector<std::shared_ptr<const TileOp>>& ops);

/// Reflects the particles below the ground that are neither Empty nor Stuck, and marks them Hit and Collided.
/// The result has the same bits as bounce() for each row.
void bounceTile(const GroundContact& ground, Tile& tile);

} // namespace fx::sim
