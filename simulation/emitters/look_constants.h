/// @file look_constants.h
/// Constants and columns of the groups that emitters publish for drawing.
#pragma once

#include "simulation/emitters/emitter_def.h"
#include "simulation/particles/look_kernel.h"

#include <span>

namespace fx::sim {

/// @param arcPerTile [m] of a ribbon; 1 elsewhere
void writeConstants(const EmitterDef& def, const EmitterLook& look, float arcPerTile,
                    std::span<float> constants);

/// The columns of a group of the kind "particle", null where it lacks one.
LookColumns columnsOf(base::SnapshotGroup& group);

} // namespace fx::sim
