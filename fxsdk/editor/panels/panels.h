/// @file panels.h
/// The panels of the editor. Each function draws the contents of one window of ImGui.
#pragma once

#include "fxsdk/editor/panels/panel_state.h"
#include "fxsdk/editor/session/view_projection.h"

namespace fx::editor {

void topBar(PanelState& state);         ///< file, undo, exposure, messages
void outlinerPanel(PanelState& state);  ///< elements of techniques with solo and mute, other parts
void inspectorPanel(PanelState& state); ///< members of the selection
void viewportPanel(PanelState& state);  ///< the picture, its camera and its handles
void viewportBar(PanelState& state);    ///< choices of stage, overlays and comparisons of the picture
void timelinePanel(PanelState& state);  ///< play, scrub, marks of bursts
void curvePanel(PanelState& state);     ///< keys of the curve or gradient that is edited
void findingsPanel(PanelState& state);  ///< errors and warnings with remedies
void changesPanel(PanelState& state);   ///< A and B, and the difference as text
void budgetPanel(PanelState& state); ///< particles and time of elements, stages and qualities on this machine
void renderMenu(PanelState& state);  ///< button that writes a picture, a sequence, a turntable or a video
void gamesPanel(PanelState& state);  ///< running games with a live link, and the one that shows the edits

/// Questions that must be answered first: recovery after a crash, a file that has changed outside.
void questionPanel(PanelState& state);

/// Begins to show the edited preset in the game at `address`. The token is that of FXSDK_LINK_TOKEN.
void startLink(PanelState& state, const link::Address& address);

/// State of the link, for people, such as "my-game: shown by 3 instances".
std::string linkText(const PanelState& state);

/// Title of an element for people, such as "Emitter: flames"; of the array of a technique "all emitters".
std::string elementTitle(const Document& document, const std::string& pointer);

/// Draws what the session chooses over the picture: wires, overdraw. @param view of the picture
void drawOverlays(PanelState& state, const ViewProjection& view, ImVec2 low, ImVec2 high);

/// Handles of shapes, of the sun and of the comparison: draws them, and moves the one that is held. Call it
/// after the item of the picture. @return whether the mouse holds one
bool viewportHandles(PanelState& state, const ViewProjection& view, ImVec2 low, ImVec2 high);

/// Numbers and color of the sky. @param prefix of the places of the widgets
void skyFields(PanelState& state, const std::string& prefix, StageChoice& io);

/// A button with a place. @return true when it was clicked
bool button(PanelState& state, const char* label, const std::string& name);

/// A line of text with a place. @param width [pixel]
void textField(PanelState& state, const char* label, const std::string& name, float width, std::string& io);

/// Puts the next button into the line of the last one if there is room for its label.
void sameLineIfItFits(const char* label);
void sameLineIfItFits(float width); ///< @param width [pixel] of the next widgets

} // namespace fx::editor
