/// @file field_detail_preset.h
/// The member "detail" of media (schema/field_detail.schema.json), shared by several techniques.
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/detail/field_detail.h"

namespace fx::preset {

/// Reads the member "detail" of `element`. If the member is absent, `out` does not change.
void readFieldDetail(const PresetValue& element, sim::FieldDetail& out);

} // namespace fx::preset
