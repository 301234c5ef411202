/// @file panels.h
/// The panels of the editor. Each function draws the contents of one window of ImGui.
#pragma once

#include "fxsdk/editor/panels/panel_state.h"

namespace fx::editor {

void topBar(PanelState& state);         ///< file, undo, exposure, messages
void outlinerPanel(PanelState& state);  ///< elements of techniques with solo and mute, other parts
void inspectorPanel(PanelState& state); ///< members of the selection
void viewportPanel(PanelState& state);  ///< the picture and its camera
void timelinePanel(PanelState& state);  ///< play, scrub, marks of bursts
void curvePanel(PanelState& state);     ///< keys of the curve or gradient that is edited
void findingsPanel(PanelState& state);  ///< errors and warnings with remedies
void changesPanel(PanelState& state);   ///< A and B, and the difference as text
void gamesPanel(PanelState& state);     ///< running games with a live link, and the one that shows the edits

/// Questions that must be answered first: recovery after a crash, a file that has changed outside.
void questionPanel(PanelState& state);

/// Begins to show the edited preset in the game at `address`. The token is that of FXSDK_LINK_TOKEN.
void startLink(PanelState& state, const link::Address& address);

/// State of the link, for people, such as "my-game: shown by 3 instances".
std::string linkText(const PanelState& state);

/// Title of an element for people, such as "Emitter flames".
std::string elementTitle(const Document& document, const std::string& pointer);

/// A button with a place. @return true when it was clicked
bool button(PanelState& state, const char* label, const std::string& name);

} // namespace fx::editor
