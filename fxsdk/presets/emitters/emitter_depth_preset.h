/// @file emitter_depth_preset.h
/// Collisions with what a view shows (shape "depth" of an emitter's "collisions").
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/solver/effect_def.h"

namespace fx::preset {

/// Warns of such collisions where the CPU computes the emitter, and says why it does: its particles move
/// freely.
/// @param root the preset, whose emitters `effect` holds as its first solvers, joined by their events
void warnOfDepthOnCpu(const PresetValue& root, const sim::EffectDef& effect);

} // namespace fx::preset
