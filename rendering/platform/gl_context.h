/// @file gl_context.h
/// Creates OpenGL 4.5 core contexts for tools and tests. A game uses its own context. The renderer depends
/// only on the function loader, not on the platform.
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
    bool debug = false;          ///< true: create a debug context; the driver reports misuse, see GlMessages
    bool visible = false;        ///< true: the window is visible; used by GLFW only
    int width = 64;              ///< [pixel] width of the window; EGL contexts have no window
    int height = 64;             ///< [pixel]
    const char* title = "fxsdk"; ///< title of the window
};

class GlContext
{
public:
    virtual ~GlContext() = default;

    virtual GlLoader loader() = 0;
    virtual base::Status makeCurrent() = 0;
    /// Displays the picture in the window. Has no effect without a window.
    virtual void swapBuffers() = 0;
    /// Handles events of the window. @return true if the user has requested to close the window
    virtual bool closeRequested() { return false; }
    /// Returns the kind of context as text, such as "EGL surfaceless (Mesa)".
    virtual std::string description() const = 0;
};

/// Creates a context without a window, and makes the context current. Tries EGL_MESA_platform_surfaceless,
/// then an EGL device, then the default display. Defined in fx_platform_egl.
/// @return GlUnsupported with the errors of all three attempts
base::Result<std::unique_ptr<GlContext>> createEglContext(const GlContextOptions& options);

/// Creates a context with a window, and makes the context current. The window is visible if options.visible
/// is true. Defined in fx_platform_glfw.
/// @return GlUnsupported with the message of GLFW
base::Result<std::unique_ptr<GlContext>> createGlfwContext(const GlContextOptions& options);

} // namespace fx::render
