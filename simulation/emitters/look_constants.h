/// @file look_constants.h
/// Constants of the groups that emitters publish for drawing.
#pragma once

#include "simulation/emitters/emitter_def.h"

#include <span>

namespace fx::sim {

/// @param arcPerTile [m] of a ribbon; 1 elsewhere
void writeConstants(const EmitterDef& def, const EmitterLook& look, float arcPerTile,
                    std::span<float> constants);

/// [1] How far the farthest corner of what is drawn is from its center, over the half height.
float cornerOf(const EmitterLook& look);

} // namespace fx::sim
