/// @file json_locator.h
/// Finds positions in JSON text by parsing the text a second time. The parsed document therefore stores no
/// positions.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fx::preset {

struct JsonPlace
{
    size_t key = 0;   ///< [byte] offset of the member's name; inside arrays, offset of the value
    size_t value = 0; ///< [byte] offset of the value
};

/// The position of each JSON pointer in `text`. A pointer to a missing value gets the position of its nearest
/// ancestor. Of several equal names, the first is used. Text after a syntax error is ignored.
std::vector<JsonPlace> locateJson(std::string_view text, std::span<const std::string> pointers);

} // namespace fx::preset
