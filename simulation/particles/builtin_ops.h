/// @file builtin_ops.h
/// The modules that every emitter may have: the members of EmitterForces.
#pragma once

#include "simulation/emitters/emitter_def.h"

#include <memory>
#include <vector>

namespace fx::sim {

/// Appends those that `def` needs, in the order in which they run.
void addBuiltinOps(const EmitterDef& def, std::vector<std::shared_ptr<const TileOp>>& ops);

} // namespace fx::sim
