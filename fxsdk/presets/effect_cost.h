/// @file effect_cost.h
/// Estimated cost of an instance of a preset, and warnings about high costs.
#pragma once

#include "fxsdk/presets/technique.h"

namespace fx::preset {

/// Work of a step of 1/60 s above which a warning is given: the default budget of an update, about 100 ms.
constexpr double kMuchStepWork = 10e6; // [unit]
/// Prewarm that counts more is warned about: about 1 s.
constexpr double kMuchStartWork = 100e6; // [unit]
/// An instance that takes more memory is warned about.
constexpr uint64_t kMuchMemory = uint64_t(1) << 30; // [byte]

/// Fills in effect.cost and warns of work and memory beyond the limits above, naming the member to change.
/// @param techniques those that the solvers of `effect` were built by
void estimateCost(const PresetValue& root, sim::EffectDef& effect, Techniques techniques);

} // namespace fx::preset
