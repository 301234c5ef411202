/// @file number_field.h
/// A number that is typed, with arithmetic and units, or dragged.
#pragma once

#include "fxsdk/editor/inspector/member.h"
#include "fxsdk/editor/panels/panel_state.h"

#include <optional>
#include <string>

namespace fx::editor {

/// A changed number.
struct NumberEdit
{
    double value;
    uint64_t gesture; ///< 0: typed
};

/// Draws a field. @param value NaN: none @param name unique in its window, and the name of its place
/// @param width [pixel] @return the new number when it has changed
std::optional<NumberEdit> numberField(PanelState& state, const std::string& name, double value,
                                      const Member& member, float width);

/// Text of a number with at most seven digits.
std::string numberText(double value);

} // namespace fx::editor
