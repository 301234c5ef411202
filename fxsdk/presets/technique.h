/// @file technique.h
/// The preset part of a technique: its members of the preset format, and their conversion to solvers.
#pragma once

#include "foundation/snapshot/snapshot_schema.h"
#include "fxsdk/presets/preset_value.h"
#include "fxsdk/presets/solver_cost.h"
#include "simulation/solver/effect_def.h"

#include <span>
#include <string_view>

namespace fx::preset {

/// One technique. Its reader, schema, warnings and costs are in its own folder.
struct Technique
{
    std::string_view name;

    /// Member of a preset whose array elements are this technique's solvers.
    std::string_view presetMember;

    /// JSON Schema of one element, with the kinds of schema_assembly.h.
    std::string_view (*schema)();

    /// Reads one validated element and adds one solver to `effect`.
    void (*build)(const PresetValue& element, sim::EffectDef& effect);

    /// Resolves references between elements. Called after the solvers of all techniques have been built, even
    /// if there were errors. Null: elements have no references.
    void (*link)(const PresetValue& root, sim::EffectDef& effect) = nullptr;

    /// Warns of members of the preset `root` that are valid but have no effect. Called only without errors.
    /// Null: no warnings.
    void (*lint)(const PresetValue& root, const sim::EffectDef& effect) = nullptr;

    /// Refines the costs of its solvers and names the members that determine them. `ioCosts` has one entry
    /// for each element, initialized from the definition of its solver. Null: no refinement.
    void (*estimate)(const PresetValue& root, const sim::EffectDef& effect,
                     std::span<SolverCost> ioCosts) = nullptr;

    /// Kinds of snapshot data that its solvers may publish.
    std::span<const base::KindDesc* const> kinds = {};
};

/// The techniques of a build or of one context. Solvers of an effect are in the order of this list.
using Techniques = std::span<const Technique>;

/// A preset member whose technique is not part of this build.
struct MissingTechnique
{
    std::string_view presetMember;
    std::string_view option; ///< name of the CMake option that enables the technique
};

} // namespace fx::preset
