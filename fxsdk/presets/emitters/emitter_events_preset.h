/// @file emitter_events_preset.h
/// Joins the emitters of a preset by their events (member "events" of emitters.schema.json).
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/solver/effect_def.h"

namespace fx::preset {

/// Reads the events of all emitters of the preset `root`, which `effect` holds as its first solvers, and puts
/// the solvers in order. Adds findings for names that no emitter has, for circles, and for emitters in which
/// nothing would ever be born.
void linkEmitterEvents(const PresetValue& root, sim::EffectDef& effect);

} // namespace fx::preset
