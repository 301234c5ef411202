/// @file emitter_depth_preset.h
/// Collisions with the depth texture of a view (shape "depth" of an emitter's "collisions").
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/solver/effect_def.h"

namespace fx::preset {

/// Warns that such collisions have no effect when the CPU computes the emitter, with the reason for the CPU.
/// @param root the preset; the first solvers of `effect` are its emitters, linked by their events
void warnOfDepthOnCpu(const PresetValue& root, const sim::EffectDef& effect);

} // namespace fx::preset
