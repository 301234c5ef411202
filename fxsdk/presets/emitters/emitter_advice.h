/// @file emitter_advice.h
/// Lint warnings: members of a preset that are valid and have no effect, or cost more than expected.
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/solver/effect_def.h"

namespace fx::preset {

// Parts of adviseEmitters(), each for one emitter.
void adviseForces(const PresetValue& element, bool hasGround);
void adviseShape(const PresetValue& element);
void adviseAppearance(const PresetValue& element, const sim::EmitterDef& emitter);

/// What does not fit: emitters whose particles, those that events give birth to included, exceed their
/// capacity, and memory above 1 GiB.
void adviseCapacity(const PresetValue& root, const sim::EffectDef& effect);

} // namespace fx::preset
