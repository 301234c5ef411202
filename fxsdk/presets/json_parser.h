/// @file json_parser.h
/// Parses JSON text (RFC 8259). Text that is too large, too deep or ambiguous is refused before it is built.
#pragma once

#include "fxsdk/presets/findings.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fx::preset {

/// Limits of a JSON document, all checked before or while it is parsed, never afterwards.
struct JsonLimits
{
    uint64_t bytes;         ///< [byte] of text
    size_t depth;           ///< arrays and objects inside each other
    size_t nodes;           ///< values
    size_t tokenBytes;      ///< [byte] of a string, name or number
    size_t arrayElements;   ///< elements of one array, members of one object
    uint64_t documentBytes; ///< [byte] of memory that the parsed document may take, estimated from above
};

constexpr JsonLimits kPresetLimits{uint64_t(4) << 20, 32, 65'536, 4'096, 16'384, uint64_t(32) << 20};
constexpr JsonLimits kSceneLimits{uint64_t(64) << 20, 32, 4'000'000, 4'096, 16'384, uint64_t(96) << 20};

/// The document, or nothing when `findings` got an error: text that is not well formed or not UTF-8, a name
/// that occurs twice in an object, a limit that is exceeded. Memory stays below limits.documentBytes plus a
/// token.
std::optional<nlohmann::json> parseJson(std::string_view text, const JsonLimits& limits, Findings& findings);

} // namespace fx::preset
