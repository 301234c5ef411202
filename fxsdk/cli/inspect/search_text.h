/// @file search_text.h
/// Search of a word in a text, whatever the letter case.
#pragma once

#include <algorithm>
#include <cctype>
#include <string_view>

namespace fx::cli {

inline bool containsIgnoringCase(std::string_view text, std::string_view word)
{
    const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

} // namespace fx::cli
