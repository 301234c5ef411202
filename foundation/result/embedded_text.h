/// @file embedded_text.h
/// A text file that was compiled into the library (cmake/FxEmbed.cmake makes the tables).
#pragma once

#include <string_view>

namespace fx::base {

struct EmbeddedText
{
    std::string_view name; ///< path relative to its base folder, with '/'
    std::string_view text;
};

} // namespace fx::base
