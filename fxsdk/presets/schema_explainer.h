/// @file schema_explainer.h
/// Says in words why a value does not fit its schema. The judge is valijson; this only looks at what it
/// pointed to.
#pragma once

#include "fxsdk/presets/findings.h"

#include <nlohmann/json.hpp>

#include <string>

namespace fx::preset {

/// The part of `schema` that speaks about the value at `pointer` of `document`, choices not yet taken; null
/// when the schema or the document does not go that far.
const nlohmann::json* schemaAt(const nlohmann::json& schema, const nlohmann::json& document,
                               const nlohmann::json::json_pointer& pointer);

/// Adds a finding for each objection to `value` itself; what is wrong inside its members is not looked at.
/// @return number of findings
size_t explain(const nlohmann::json& schema, const nlohmann::json& value, const std::string& pointer,
               Findings& findings);

/// What `schema` allows, such as `a number from 0 to 1`.
std::string allowedText(const nlohmann::json& schema);

/// What `value` is, such as `"abc"` or `an array of 3 elements`.
std::string foundText(const nlohmann::json& value);

} // namespace fx::preset
