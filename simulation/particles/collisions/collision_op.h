/// @file collision_op.h
/// Module of a tile that contains all obstacles of an emitter.
///
/// All obstacles are in one module, because the order of contacts determines the motion. The response to one
/// contact must not push a particle into another obstacle.
#pragma once

#include "simulation/particles/collisions/collision_defs.h"
#include "simulation/particles/tile.h"

#include <memory>
#include <span>

namespace fx::sim {

/// Creates the module for all obstacles of an emitter.
/// @param defs obstacles; only the first kMaxObstacles are used
std::unique_ptr<TileOp> makeCollisionOp(std::span<const CollisionDef> defs);

} // namespace fx::sim
