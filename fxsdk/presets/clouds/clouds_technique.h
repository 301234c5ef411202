/// @file clouds_technique.h
/// The preset member "clouds" (clouds.schema.json).
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "fxsdk/presets/technique.h"

namespace fx::preset {

std::string_view cloudsSchema();

/// Adds the cloud that `element` describes to `effect`, or a finding about its file.
void buildCloud(const PresetValue& element, sim::EffectDef& effect);

inline constexpr const base::KindDesc* kCloudKinds[] = {&base::kBlobKind};

inline constexpr Technique kCloudsTechnique{
    .name = "clouds",
    .presetMember = "clouds",
    .schema = cloudsSchema,
    .build = buildCloud,
    .kinds = kCloudKinds,
};

} // namespace fx::preset
