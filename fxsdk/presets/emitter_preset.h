/// @file emitter_preset.h
/// Reads one element of a preset's "emitters" (schema/emitters.schema.json).
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/solver/effect_def.h"

namespace fx::preset {

/// Adds the emitter that `element` describes to `effect`. Adds findings, and no emitter that could do harm,
/// when the element says what its schema cannot forbid.
void buildEmitter(const PresetValue& element, sim::EffectDef& effect);

} // namespace fx::preset
