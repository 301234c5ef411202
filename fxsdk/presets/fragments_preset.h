/// @file fragments_preset.h
/// Reads one element of a preset's "fragments" (schema/fragments.schema.json).
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/solver/effect_def.h"

namespace fx::preset {

/// Adds the burst of fragments that `element` describes to `effect`, and findings about what its schema
/// cannot say.
void buildFragments(const PresetValue& element, sim::EffectDef& effect);

} // namespace fx::preset
