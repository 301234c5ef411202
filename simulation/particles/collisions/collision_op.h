/// @file collision_op.h
/// All obstacles of an emitter as one module of a tile.
///
/// It is one module for all obstacles, because the order of contacts determines the motion, and resolving one
/// contact must not push a particle into another obstacle.
#pragma once

#include "simulation/particles/collisions/collision_defs.h"
#include "simulation/particles/tile.h"

#include <memory>
#include <span>

namespace fx::sim {

/// @param defs at most kMaxObstacles are used
std::unique_ptr<TileOp> makeCollisionOp(std::span<const CollisionDef> defs);

} // namespace fx::sim
