/// @file json_limits.h
/// How large a JSON document may be; all checked before or while it is parsed, never afterwards.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fx::preset {

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

} // namespace fx::preset
