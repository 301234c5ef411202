/// @file schema_assembly.h
/// The JSON Schemas (draft 7) of presets and scenes, put together from the texts in schema/ and those of
/// techniques.
///
/// The texts say `"x-kind"` for the values that presets are made of; assembling replaces it by what the kind
/// stands for and keeps it for documentation, as `"x-unit"` and `"x-cost"`:
///   range       a number, or {"min": a, "max": b}
///   curve       a number, or {"keys": [[t, value], ...]}
///   colorCurve  a color,  or {"keys": [[t, color], ...]}
///   color       [r, g, b], linear Rec. 709
///   vector      [x, y, z]
///   extent      a number for all three axes, or [x, y, z]
/// `"minimum"` and `"maximum"` beside it hold for every number inside.
#pragma once

#include "fxsdk/techniques.h"

#include <nlohmann/json.hpp>

namespace fx::preset {

/// Schema of `*.fx.json` with these techniques. Members keep the order of the texts.
nlohmann::ordered_json presetSchema(Techniques techniques = preset::techniques());

/// Schema of `*.scene.json`.
nlohmann::ordered_json sceneSchema();

} // namespace fx::preset
