/// @file gl_context.h
/// Creates OpenGL 4.5 core contexts for tools and tests; a game uses its own context. The renderer depends on
/// the loader only, not on the platform.
///
/// Threads: a context belongs to the thread on which it is current.
#pragma once

#include "foundation/result/status.h"
#include "rendering/gl/gl_functions.h"

#include <memory>
#include <string>

namespace fx::render {

struct GlContextOptions
{
    bool debug = false;   ///< true: create a debug context, whose driver reports misuse, see GlMessages
    bool visible = false; ///< used by GLFW only: true: the window is visible
    int width = 64;       ///< [pixel] width of the window; EGL contexts have no window
    int height = 64;      ///< [pixel]
    const char* title = "fxsdk"; ///< title of the window
};

class GlContext
{
public:
    virtual ~GlContext() = default;

    virtual GlLoader loader() = 0;
    virtual base::Status makeCurrent() = 0;
    /// Displays the picture in the window; does nothing without a window.
    virtual void swapBuffers() = 0;
    /// Handles events of the window. @return true if the user has requested to close the window
    virtual bool closeRequested() { return false; }
    /// Text about the kind of context, such as "EGL surfaceless (Mesa)".
    virtual std::string description() const = 0;
};

/// Creates a context without a window, and makes it current. Tries EGL_MESA_platform_surfaceless, then an EGL
/// device, then the default display. Defined in fx_platform_egl.
/// @return GlUnsupported with the errors of all three
base::Result<std::unique_ptr<GlContext>> createEglContext(const GlContextOptions& options);

/// Creates a context with a window, which is hidden unless options.visible, and makes it current. Defined in
/// fx_platform_glfw.
/// @return GlUnsupported with the message of GLFW
base::Result<std::unique_ptr<GlContext>> createGlfwContext(const GlContextOptions& options);

} // namespace fx::render
