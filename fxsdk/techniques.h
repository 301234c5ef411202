/// @file techniques.h
/// The explicit list of techniques: what each brings to presets, simulation, snapshots and rendering.
///
/// Adding a technique, or leaving one out of a build, touches this list and the technique's own folder,
/// nothing else.
#pragma once

#include "foundation/snapshot/snapshot_schema.h"
#include "fxsdk/presets/preset_value.h"
#include "simulation/solver/effect_def.h"

#include <span>
#include <string_view>

namespace fx::preset {

struct Technique
{
    std::string_view name;
    /// Member of a preset whose array elements are this technique's solvers; empty when presets do not speak
    /// of it.
    std::string_view presetMember;
    /// File below presets/schema with the JSON Schema of one element; empty without a preset member.
    std::string_view schemaFile;
    /// Reads one validated element and adds its solver to `effect`. Null without a preset member.
    void (*build)(const PresetValue& element, sim::EffectDef& effect);
    /// Whether an effect makes use of it. Null: an effect that publishes `kind`.
    bool (*isUsedBy)(const sim::EffectDef& effect);
    /// Kind of snapshot data that its solvers publish; null when it publishes none.
    const base::KindDesc* kind;
    /// Passes of the frame graph that exist because of it.
    std::span<const std::string_view> passes;
};

/// A preset member that belongs to a technique which this build lacks.
struct MissingTechnique
{
    std::string_view presetMember;
    std::string_view option; ///< the CMake option that would bring it
};

std::span<const Technique> techniques();
/// Whether an effect makes use of a technique without a preset member.
bool isUsed(const Technique& technique, const sim::EffectDef& effect);
std::span<const MissingTechnique> missingTechniques();

/// Registers what the techniques publish. Called once per context.
void registerKinds(base::SnapshotSchema& schema);

} // namespace fx::preset
