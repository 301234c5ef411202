/// @file json_parser.h
/// Parses JSON text (RFC 8259). Text that is too large, too deep or ambiguous is refused before it is built.
#pragma once

#include "fxsdk/presets/findings.h"
#include "fxsdk/presets/json_limits.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string_view>

namespace fx::preset {

/// The document, or nothing when `findings` got an error: text that is not well formed or not UTF-8, a name
/// that occurs twice in an object, a limit that is exceeded. Memory stays below limits.documentBytes plus a
/// token.
std::optional<nlohmann::json> parseJson(std::string_view text, const JsonLimits& limits, Findings& findings);

} // namespace fx::preset
