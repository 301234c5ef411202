/// @file technique.h
/// The preset half of a technique: what it adds to the format of presets, and how its members become solvers.
#pragma once

#include "foundation/snapshot/snapshot_schema.h"
#include "fxsdk/presets/preset_value.h"
#include "fxsdk/presets/solver_cost.h"
#include "simulation/solver/effect_def.h"

#include <span>
#include <string_view>

namespace fx::preset {

/// One technique. Its reader, its schema, its warnings and its costs are in a folder of its own.
struct Technique
{
    std::string_view name;

    /// Member of a preset whose array elements are this technique's solvers.
    std::string_view presetMember;

    /// JSON Schema of one element, with the kinds of schema_assembly.h.
    std::string_view (*schema)();

    /// Reads one validated element and adds one solver to `effect`.
    void (*build)(const PresetValue& element, sim::EffectDef& effect);

    /// Resolves what elements say of each other, once the solvers of all techniques are there. Called also
    /// after errors. Null: they say nothing.
    void (*link)(const PresetValue& root, sim::EffectDef& effect) = nullptr;

    /// Warns of what is valid in the preset `root` and has no effect. Called without errors only. Null: there
    /// are no such warnings.
    void (*lint)(const PresetValue& root, const sim::EffectDef& effect) = nullptr;

    /// Makes the costs of its solvers exact, and names the members that decide them. `ioCosts` has one for
    /// each element, as the definition of its solver states it. Null: they are exact.
    void (*estimate)(const PresetValue& root, const sim::EffectDef& effect,
                     std::span<SolverCost> ioCosts) = nullptr;

    /// Kinds of snapshot data that its solvers may publish.
    std::span<const base::KindDesc* const> kinds = {};
};

/// The techniques of a build, or of one context. Solvers of an effect are in the order of this list.
using Techniques = std::span<const Technique>;

/// A preset member that belongs to a technique which this build lacks.
struct MissingTechnique
{
    std::string_view presetMember;
    std::string_view option; ///< the CMake option that would bring it
};

} // namespace fx::preset
