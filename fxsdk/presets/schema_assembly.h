/// @file schema_assembly.h
/// Assembles the JSON Schemas (draft 7) of presets and scenes from the texts in schema/ and the texts of
/// techniques.
///
/// `"x-kind"` names a type of value and is expanded to the schema of that type. The members `"x-kind"`,
/// `"x-unit"` and `"x-cost"` are kept for the documentation. Types:
///   range       a number, or {"min": a, "max": b}
///   curve       a number, or {"keys": [[t, value], ...]}
///   colorCurve  a color,  or {"keys": [[t, color], ...]}
///   color       [r, g, b], linear Rec. 709
///   vector      [x, y, z]
///   extent      a number for all three axes, or [x, y, z]
/// `"minimum"` and `"maximum"` beside `"x-kind"` apply to every number inside the value.
#pragma once

#include "fxsdk/techniques.h"

#include <nlohmann/json.hpp>

namespace fx::preset {

/// Schema of `*.fx.json` with the members of `techniques`, in the order of the texts.
nlohmann::ordered_json presetSchema(Techniques techniques = preset::techniques());

/// Schema of `*.scene.json`.
nlohmann::ordered_json sceneSchema();

} // namespace fx::preset
