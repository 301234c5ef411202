/// @file json_writer.h
/// Writes JSON in the layout of the preset library: two blanks per level, short values on one line. Values
/// that have not changed keep their text, so that a saved file differs only where it was edited.
#pragma once

#include "fxsdk/editor/document/text_spans.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace fx::editor {

/// JSON with members in the order of the text.
using Json = nlohmann::ordered_json;

/// [column] Values that end at or before this column are written on one line.
constexpr size_t kLineColumns = 140;

/// Returns the text of a document, with a line feed at the end.
std::string writeJson(const Json& document);

/// Returns the text of `document`, in which values that are equal in `before` keep their part of
/// `beforeText`. Equal documents give `beforeText` itself.
std::string writeJson(const Json& document, const Json& before, std::string_view beforeText);

} // namespace fx::editor
