/// @file emitter_advice.h
/// Warnings about what is valid in a preset and yet does nothing, or takes more than its author may expect.
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/solver/effect_def.h"

namespace fx::preset {

/// Adds warnings for the emitters of the preset `root`, which `effect` holds as its first solvers, once their
/// events are joined.
void adviseEmitters(const PresetValue& root, const sim::EffectDef& effect);

// Its parts, each for one emitter.
void adviseForces(const PresetValue& element, bool hasGround);
void adviseShape(const PresetValue& element);
void adviseLook(const PresetValue& element, const sim::EmitterDef& emitter);

/// What does not fit: emitters whose particles, those that events give birth to included, exceed their
/// capacity, and memory above 1 GiB.
void adviseCapacity(const PresetValue& root, const sim::EffectDef& effect);

} // namespace fx::preset
