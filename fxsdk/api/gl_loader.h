/// @file gl_loader.h
/// The OpenGL context that is current on this thread, as the window systems of the process know it.
#pragma once

namespace fx::api {

/// True if EGL, GLX or SDL knows a current context. False also if none of these libraries is loaded.
bool isGlContextCurrent();

} // namespace fx::api
