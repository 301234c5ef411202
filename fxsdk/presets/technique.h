/// @file technique.h
/// The preset part of a technique: a member of the preset format, and the conversion of its elements to
/// solvers.
#pragma once

#include "foundation/snapshot/snapshot_schema.h"
#include "fxsdk/presets/preset_value.h"
#include "fxsdk/presets/solver_cost.h"
#include "simulation/solver/effect_def.h"

#include <span>
#include <string_view>

namespace fx::preset {

/// One technique. The reader, schema, warnings and costs of a technique are in one folder.
struct Technique
{
    std::string_view name;

    /// Name of the preset's array whose elements define the technique's solvers.
    std::string_view presetMember;

    /// Returns the JSON Schema of one element. The schema may use the kinds of schema_assembly.h.
    std::string_view (*schema)();

    /// Reads one validated element and adds one solver to `effect`.
    void (*build)(const PresetValue& element, sim::EffectDef& effect);

    /// Resolves references between elements. The function is called after the solvers of all techniques have
    /// been built, even after errors. Null: elements have no references.
    void (*link)(const PresetValue& root, sim::EffectDef& effect) = nullptr;

    /// Warns of members of the preset `root` that are valid but have no effect. The function is called only
    /// for presets without errors. Null: no warnings.
    void (*lint)(const PresetValue& root, const sim::EffectDef& effect) = nullptr;

    /// Refines the costs of the technique's solvers, and names the members that determine the costs.
    /// `ioCosts` has one entry for each element, initialized from the definition of the solver. Null: no
    /// refinement.
    void (*estimate)(const PresetValue& root, const sim::EffectDef& effect,
                     std::span<SolverCost> ioCosts) = nullptr;

    /// Kinds of snapshot data that the technique's solvers may publish.
    std::span<const base::KindDesc* const> kinds = {};
};

/// List of the techniques of a build or of one context. The solvers of an effect have the order of the list.
using Techniques = std::span<const Technique>;

/// A preset member whose technique is not part of this build.
struct MissingTechnique
{
    std::string_view presetMember;
    std::string_view option; ///< name of the CMake option that enables the technique
};

} // namespace fx::preset
