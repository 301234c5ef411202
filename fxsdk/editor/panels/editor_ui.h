/// @file editor_ui.h
/// The whole editor as windows of ImGui. A host calls it between ImGui::NewFrame() and ImGui::Render(), with
/// its own renderer and input.
#pragma once

#include "fxsdk/editor/panels/panel_state.h"

namespace fx::editor {

/// Sets colors, distances and the font of the current ImGui context. Call it once, before the first frame.
/// @param scale [1] size of text and widgets; 1: text of 16 pixels
void applyStyle(float scale);

/// Draws all panels into a rectangle of the display [pixel], and runs keyboard commands: Ctrl+Z undo, Ctrl+Y
/// redo, Ctrl+S save, Space play.
void drawEditor(PanelState& state, ImVec2 low, ImVec2 size);

} // namespace fx::editor
