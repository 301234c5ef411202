/// @file headless_editor.h
/// The editor without a display: the frames of the window, with the input of a script.
///
/// A script has one command a line; "#" begins a comment. NAME is the place of a widget, such as
/// "/emitters/0/lifetime/0" (`places` lists them). Panels scroll to widgets that are used.
///   frames N              draws N frames
///   click NAME            clicks; also doubleclick and rightclick
///   open NAME             opens the header NAME, or those in which the widget lies; what is open stays so
///   drag NAME DX DY       drags from the middle of the widget by so many pixels
///   at NAME FX FY         clicks at fractions of the widget's width and height
///   type TEXT             types the rest of the line
///   key KEY               presses a key such as enter, ctrl+z
///   strike KEY KEY ...    presses and releases keys one after the other before the next frame
///   move X Y, press B, release B, wheel N    events of the mouse; B is 0, 1 or 2
///   shot FILE             writes the window as PNG
///   text FILE             writes the document as the editor would save it
///   time SECONDS          scrubs
///   places                prints the names of all widgets
///   compared              waits for the comparison with the reference renderer, and prints its result
///   measured                waits for the budget, and prints it
///   rendered                waits for the pictures of the button "Render", and prints the message
///   linked                waits until the running game has answered to the last edit, and prints the answer
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/editor/session/session.h"

#include <memory>
#include <string>

namespace fx::editor {

struct HeadlessOptions
{
    int width = 1600;      ///< [pixel]
    int height = 1000;     ///< [pixel]
    float scale = 1.0f;    ///< [1] of text
    std::string script;    ///< file; empty: none
    std::string output;    ///< PNG of the last frame; empty: none
    int measuredEdits = 0; ///< edits whose time until the picture is measured
    bool isLinked = false; ///< shows edits in a running game
    std::string link;      ///< its address; empty: the only one that is running
};

/// Runs the editor and prints what `places` and measuredEdits ask for.
/// @return an error names the line of the script. Edits that were not saved by then are kept as a recovery
///         file, which the message names
base::Status runHeadless(std::unique_ptr<Session> session, const HeadlessOptions& options);

} // namespace fx::editor
