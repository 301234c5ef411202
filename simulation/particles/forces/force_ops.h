/// @file force_ops.h
/// Creates tile modules for the forces of force_defs.h. The formula of each force is in its own source file
/// in this folder.
#pragma once

#include "simulation/particles/forces/force_defs.h"
#include "simulation/particles/tile.h"

#include <memory>

namespace fx::sim {

std::unique_ptr<TileOp> makeGustOp(const GustDef& def);
/// Quadratic drag. The acceleration is -q |v - u| (v - u), where v is the velocity of the particle and u the
/// velocity of the air.
/// @param coefficient [1/m] q, >= 0
std::unique_ptr<TileOp> makeQuadraticDragOp(float coefficient);
std::unique_ptr<TileOp> makeVortexOp(const VortexDef& def);
/// Creates the force of an attractor without its kill radius. makeCollisionOp() implements the kill radius as
/// a sphere.
std::unique_ptr<TileOp> makeAttractorOp(const AttractorDef& def);
std::unique_ptr<TileOp> makeVectorFieldOp(const VectorFieldDef& def);
std::unique_ptr<TileOp> makeConformOp(const ConformDef& def);

/// Smooth noise between -1 and 1 as a function of `phase`, with mean 0. The noise of the axes 0, 1 and 2 is
/// independent.
float gustNoise(uint64_t seed, uint32_t solverIndex, double phase, int axis);

} // namespace fx::sim
