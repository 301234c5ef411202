/// @file emitter_lint.h
/// Lint warnings: members of a preset that are valid and have no effect, or cost more than expected.
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/solver/effect_def.h"

namespace fx::preset {

// Parts of lintEmitters(), each for one emitter.
void lintForces(const PresetValue& element, bool hasGround);
void lintShape(const PresetValue& element);
void lintAppearance(const PresetValue& element, const sim::EmitterDef& emitter);

/// Warns of emitters whose particles, including births by events, exceed the capacity, and of memory above 1
/// GiB.
void lintCapacity(const PresetValue& root, const sim::EffectDef& effect);

} // namespace fx::preset
