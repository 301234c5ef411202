/// @file effect_cost.h
/// What an instance of a preset is expected to need, and warnings where that is much.
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/solver/effect_def.h"

namespace fx::preset {

/// A step of 1/60 s that counts more is warned about: what updates may spend by default, about 100 ms.
constexpr double kMuchStepWork = 10e6; // [unit]
/// Prewarm that counts more is warned about: about 1 s.
constexpr double kMuchStartWork = 100e6; // [unit]
/// An instance that takes more memory is warned about.
constexpr uint64_t kMuchMemory = uint64_t(1) << 30; // [byte]

/// Fills in effect.cost and warns of work and memory beyond the limits above, naming the member to change.
void estimateCost(const PresetValue& root, sim::EffectDef& effect);

} // namespace fx::preset
