/// @file text_difference.h
/// Lines that differ between two texts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fx::editor {

struct DifferenceLine
{
    char mark = ' '; ///< '-': only in the first text; '+': only in the second; ' ': in both
    std::string text;
};

/// Returns the lines that differ, with `context` equal lines before and after them. Runs of equal lines that
/// are left out become one line "...".
/// @return empty for equal texts
std::vector<DifferenceLine> difference(std::string_view before, std::string_view after, size_t context = 2);

/// The lines as text, with the mark in front of each.
std::string toString(const std::vector<DifferenceLine>& lines);

} // namespace fx::editor
