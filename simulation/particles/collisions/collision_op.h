/// @file collision_op.h
/// All obstacles of an emitter as one module of a tile.
///
/// One module, not one an obstacle: what a particle does after a contact depends on which obstacle comes
/// first, and a particle that leaves one must not be put into another.
#pragma once

#include "simulation/particles/collisions/collision_defs.h"
#include "simulation/particles/tile.h"

#include <memory>
#include <span>

namespace fx::sim {

/// @param defs at most kMaxObstacles are used
std::unique_ptr<TileOp> makeCollisionOp(std::span<const CollisionDef> defs);

} // namespace fx::sim
