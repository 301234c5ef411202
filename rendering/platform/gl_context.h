/// @file gl_context.h
/// A current OpenGL 4.5 core context for tools and tests; a game brings its own. The renderer does not depend
/// on the platform: it uses the loader only.
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
    bool debug = false;          ///< debug context: the driver reports misuse, see GlMessages
    bool visible = false;        ///< GLFW only: a window to look at
    int width = 64;              ///< [pixel] of the window; EGL contexts have none
    int height = 64;             ///< [pixel]
    const char* title = "fxsdk"; ///< of the window
};

class GlContext
{
public:
    virtual ~GlContext() = default;

    virtual GlLoader loader() = 0;
    virtual base::Status makeCurrent() = 0;
    virtual void swapBuffers() = 0;                 ///< shows the window's picture; nothing without a window
    virtual bool closeRequested() { return false; } ///< handles the window's events; true when it is to close
    virtual std::string description() const = 0;    ///< provider, such as "EGL surfaceless (Mesa)"
};

/// Without a window: EGL_MESA_platform_surfaceless, else an EGL device, else the default display. Current on
/// return.
/// @return GlUnsupported with the errors of all three. Defined in fx_platform_egl.
base::Result<std::unique_ptr<GlContext>> createEglContext(const GlContextOptions& options);

/// A window, hidden unless options.visible. Current on return.
/// @return GlUnsupported with GLFW's own message. Defined in fx_platform_glfw.
base::Result<std::unique_ptr<GlContext>> createGlfwContext(const GlContextOptions& options);

} // namespace fx::render
