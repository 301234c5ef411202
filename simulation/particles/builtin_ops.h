/// @file builtin_ops.h
/// The modules that every emitter may have: the members of EmitterForces.
#pragma once

#include "simulation/particles/emitter_settings.h"

#include <memory>
#include <vector>

namespace fx::sim {

/// Appends those that `def` needs, in the order in which they run.
void addBuiltinOps(const EmitterSettings& def, std::vector<std::shared_ptr<const TileOp>>& ops);

} // namespace fx::sim
