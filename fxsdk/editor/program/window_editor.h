/// @file window_editor.h
/// The editor in a window of GLFW.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/editor/session/session.h"

#include <memory>
#include <string>

namespace fx::editor {

struct WindowOptions
{
    int width = 1600;      ///< [pixel]
    int height = 1000;     ///< [pixel]
    float scale = 0.0f;    ///< [1] of text; 0: that of the monitor
    bool isLinked = false; ///< shows edits in a running game
    std::string link;      ///< its address; empty: the only one that is running
};

/// Runs until the window is closed. A game that is not found is named in the window.
/// @return GlUnsupported if there is no display or no OpenGL 4.5
base::Status runWindow(std::unique_ptr<Session> session, const WindowOptions& options);

} // namespace fx::editor
