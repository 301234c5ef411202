/// @file volumes_technique.h
/// The preset member "volumes" (volumes.schema.json).
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/volume_kind.h"
#include "fxsdk/presets/technique.h"

namespace fx::preset {

std::string_view volumesSchema();

/// Adds the volume that `element` describes to `effect`, or a finding about its file.
void buildVolume(const PresetValue& element, sim::EffectDef& effect);

inline constexpr const base::KindDesc* kVolumesKinds[] = {&base::kBlobKind, &base::kMaterialKind,
                                                          &base::kVolumeKind};

inline constexpr Technique kVolumesTechnique{
    .name = "volumes",
    .presetMember = "volumes",
    .schema = volumesSchema,
    .build = buildVolume,
    .kinds = kVolumesKinds,
};

} // namespace fx::preset
