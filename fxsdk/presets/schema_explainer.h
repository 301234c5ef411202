/// @file schema_explainer.h
/// Explains in words why a value violates its schema. The library valijson validates; this code explains the
/// values that valijson reports.
#pragma once

#include "fxsdk/presets/findings.h"

#include <nlohmann/json.hpp>

#include <string>

namespace fx::preset {

/// The subschema of the value at `pointer` of `document`; alternatives (anyOf and similar) are not resolved.
/// Null when the schema or the document has no such value.
const nlohmann::json* schemaAt(const nlohmann::json& schema, const nlohmann::json& document,
                               const nlohmann::json::json_pointer& pointer);

/// Adds a finding for each fault of `value` itself, not of its members.
/// @return number of findings
size_t explain(const nlohmann::json& schema, const nlohmann::json& value, const std::string& pointer,
               Findings& findings);

/// Description of the allowed values, such as `a number from 0 to 1`.
std::string allowedText(const nlohmann::json& schema);

/// Description of `value`, such as `"abc"` or `an array of 3 elements`.
std::string foundText(const nlohmann::json& value);

} // namespace fx::preset
