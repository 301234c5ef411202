/// @file json_parser.h
/// Parses JSON text (RFC 8259). Limits and ambiguities are checked while parsing, before memory is spent.
#pragma once

#include "fxsdk/presets/findings.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fx::preset {

/// Limits of a JSON document. The limits are checked before or while the document is parsed.
struct JsonLimits
{
    uint64_t bytes;         ///< [byte] maximum length of the text
    size_t depth;           ///< maximum nesting of arrays and objects
    size_t nodes;           ///< maximum number of values
    size_t tokenBytes;      ///< [byte] maximum length of a string or number
    size_t arrayElements;   ///< maximum number of elements of an array, or of members of an object
    uint64_t documentBytes; ///< [byte] maximum memory of the parsed document
};

constexpr JsonLimits kPresetLimits{uint64_t(4) << 20, 32, 65'536, 4'096, 16'384, uint64_t(32) << 20};
constexpr JsonLimits kSceneLimits{uint64_t(64) << 20, 32, 4'000'000, 4'096, 16'384, uint64_t(96) << 20};

/// Parses a document. Adds an error and returns nothing if the text is malformed or not UTF-8, a name occurs
/// twice in an object, or a limit is exceeded. Memory stays below limits.documentBytes plus one token.
std::optional<nlohmann::json> parseJson(std::string_view text, const JsonLimits& limits, Findings& findings);

} // namespace fx::preset
