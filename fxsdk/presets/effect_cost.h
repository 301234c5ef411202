/// @file effect_cost.h
/// Estimated cost of an instance of a preset, and warnings about high costs.
#pragma once

#include "fxsdk/presets/technique.h"

namespace fx::preset {

/// Limit of the work of a step of 1/60 s. Above the limit, a warning is given. The limit equals the default
/// budget of an update, about 100 ms.
constexpr double kMuchStepWork = 10e6; // [unit]
/// Limit of the work of the prewarm, about 1 s. Above the limit, a warning is given.
constexpr double kMuchStartWork = 100e6; // [unit]
/// Limit of the memory of an instance. Above the limit, a warning is given.
constexpr uint64_t kMuchMemory = uint64_t(1) << 30; // [byte]

/// Computes effect.cost. Warns when work or memory exceeds the limits above; the warning names the member to
/// change.
/// @param techniques the techniques that built the solvers of `effect`
void estimateCost(const PresetValue& root, sim::EffectDef& effect, Techniques techniques);

} // namespace fx::preset
