/// @file member_field.h
/// The widgets by which one member of a document is edited.
#pragma once

#include "fxsdk/editor/inspector/member.h"
#include "fxsdk/editor/panels/panel_state.h"

namespace fx::editor {

/// Draws the widgets of a member that is neither object nor array, and edits the document.
void memberField(PanelState& state, const Member& member);

} // namespace fx::editor
