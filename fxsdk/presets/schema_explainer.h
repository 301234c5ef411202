/// @file schema_explainer.h
/// Explains why a value violates its schema. The library valijson reports invalid values, and this code
/// writes an explanation for each value.
#pragma once

#include "fxsdk/presets/findings.h"

#include <nlohmann/json.hpp>

#include <string>

namespace fx::preset {

/// Returns the subschema of the value at `pointer` of `document`, or null if the schema or the document has
/// no value at `pointer`. Alternatives (anyOf and similar) are not resolved.
const nlohmann::json* schemaAt(const nlohmann::json& schema, const nlohmann::json& document,
                               const nlohmann::json::json_pointer& pointer);

/// Adds a finding for each fault of `value`. Faults of the members of `value` are not included.
/// @return number of findings
size_t explain(const nlohmann::json& schema, const nlohmann::json& value, const std::string& pointer,
               Findings& findings);

/// Returns a description of the allowed values, such as `a number from 0 to 1`.
std::string allowedText(const nlohmann::json& schema);

/// Returns a description of `value`, such as `"abc"` or `an array of 3 elements`.
std::string foundText(const nlohmann::json& value);

} // namespace fx::preset
