/// @file gas_preset.h
/// Reads one element of a preset's "gas" (schema/gas.schema.json).
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/solver/effect_def.h"

namespace fx::preset {

/// Adds the gas that `element` describes to `effect`.
void buildGas(const PresetValue& element, sim::EffectDef& effect);

} // namespace fx::preset
