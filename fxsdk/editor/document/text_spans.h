/// @file text_spans.h
/// Finds the part of a JSON text that holds each value, so that unchanged values keep their spelling.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace fx::editor {

/// The part [begin, end) of a text that holds a value. Objects and arrays have one child per member or
/// element, in the order of the text.
struct TextSpan
{
    size_t begin = 0; ///< [byte]
    size_t end = 0;   ///< [byte]
    std::vector<TextSpan> children;
};

/// Returns the spans of a text. @param text valid JSON, nested at most as deep as the preset format allows
TextSpan textSpans(std::string_view text);

} // namespace fx::editor
