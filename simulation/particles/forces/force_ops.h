/// @file force_ops.h
/// The forces of force_defs.h as modules of a tile. Each file of this folder contains the formula of one
/// force.
#pragma once

#include "simulation/particles/forces/force_defs.h"
#include "simulation/particles/tile.h"

#include <memory>

namespace fx::sim {

std::unique_ptr<TileOp> makeGustOp(const GustDef& def);
/// @param coefficient [1/m] >= 0: acceleration -q |v - u| (v - u) against the air
std::unique_ptr<TileOp> makeQuadraticDragOp(float coefficient);
std::unique_ptr<TileOp> makeVortexOp(const VortexDef& def);
/// A kill radius is not included; it is implemented as a sphere by makeCollisionOp().
std::unique_ptr<TileOp> makeAttractorOp(const AttractorDef& def);
std::unique_ptr<TileOp> makeVectorFieldOp(const VectorFieldDef& def);
std::unique_ptr<TileOp> makeConformOp(const ConformDef& def);

/// Smooth noise between -1 and 1 as a function of `phase`, 0 on average. The components `axis` 0..2 are
/// independent.
float gustNoise(uint64_t seed, uint32_t solverIndex, double phase, int axis);

} // namespace fx::sim
