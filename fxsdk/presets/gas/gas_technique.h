/// @file gas_technique.h
/// The preset member "gas" (gas.schema.json).
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/material_kind.h"
#include "fxsdk/presets/technique.h"

namespace fx::preset {

std::string_view gasSchema();

/// Adds the gas that `element` describes to `effect`.
void buildGas(const PresetValue& element, sim::EffectDef& effect);

void estimateGas(const PresetValue& root, const sim::EffectDef& effect, std::span<SolverCost> ioCosts);

inline constexpr const base::KindDesc* kGasKinds[] = {&base::kBlobKind, &base::kMaterialKind};

inline constexpr Technique kGasTechnique{
    .name = "sph gas",
    .presetMember = "gas",
    .schema = gasSchema,
    .build = buildGas,
    .estimate = estimateGas,
    .kinds = kGasKinds,
};

} // namespace fx::preset
