/// @file marker_preset.h
/// The preset member "markers" of the technique.
#pragma once

#include "fxsdk/presets/technique.h"
#include "tests/marker/marker_kind.h"

namespace fx::test {

std::string_view markerSchema();
void buildMarker(const preset::PresetValue& element, sim::EffectDef& effect);
/// Adds a warning for each black marker.
void lintMarkers(const preset::PresetValue& root, const sim::EffectDef& effect);

inline constexpr const base::KindDesc* kMarkerKinds[] = {&kMarkerKind};

inline constexpr preset::Technique kMarkerPreset{
    .name = "markers",
    .presetMember = "markers",
    .schema = markerSchema,
    .build = buildMarker,
    .lint = lintMarkers,
    .kinds = kMarkerKinds,
};

} // namespace fx::test
