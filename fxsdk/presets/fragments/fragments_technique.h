/// @file fragments_technique.h
/// The preset member "fragments" (fragments.schema.json).
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "fxsdk/presets/technique.h"

namespace fx::preset {

std::string_view fragmentsSchema();

/// Adds the burst of fragments that `element` describes to `effect`. Adds findings for faults that the schema
/// cannot exclude.
void buildFragments(const PresetValue& element, sim::EffectDef& effect);

void estimateFragments(const PresetValue& root, const sim::EffectDef& effect, std::span<SolverCost> ioCosts);

inline constexpr const base::KindDesc* kFragmentsKinds[] = {&base::kBlobKind};

inline constexpr Technique kFragmentsTechnique{
    .name = "fragments",
    .presetMember = "fragments",
    .schema = fragmentsSchema,
    .build = buildFragments,
    .estimate = estimateFragments,
    .kinds = kFragmentsKinds,
};

} // namespace fx::preset
