/// @file window_editor.h
/// The editor in a window of GLFW.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/editor/session/session.h"

#include <memory>

namespace fx::editor {

/// Runs until the window is closed. @param scale [1] of text; 0: that of the monitor
/// @return GlUnsupported if there is no display or no OpenGL 4.5
base::Status runWindow(std::unique_ptr<Session> session, int width, int height, float scale);

} // namespace fx::editor
