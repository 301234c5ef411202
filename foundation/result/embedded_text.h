/// @file embedded_text.h
/// A text file that was compiled into the library (cmake/FxEmbed.cmake generates the tables).
#pragma once

#include <string_view>

namespace fx::base {

struct EmbeddedText
{
    std::string_view name; ///< path of the file relative to its base folder, with '/' between folders
    std::string_view text;
};

} // namespace fx::base
