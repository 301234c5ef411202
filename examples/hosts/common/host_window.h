/// @file host_window.h
/// The window of hosts that show something else than a window library: by GLFW, or OpenGL without a window.
///
/// Threads: the main thread.
#ifndef HOST_WINDOW_H
#define HOST_WINDOW_H

#include "fxsdk/fx_context.h"
#include "host_options.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Makes an OpenGL 4.5 core context current without a window, for --headless. @return 1; 0 after printing why
int hostOpenOffscreen(void);
void hostCloseOffscreen(void);

/// Opens a window of the size of the options, or OpenGL without one for --headless.
/// @param ioOptions receives the size of the window's framebuffer, which is larger on displays that scale
/// @return 1; 0 after printing why
int hostOpenWindow(HostOptions* ioOptions, const char* title);

/// Copies a framebuffer of that size to the window and shows it at the next refresh of the display; does
/// nothing without a window.
/// @return 0 when the user closes the window
int hostPresent(unsigned framebuffer, int width, int height);

/// Closes the window or OpenGL without one.
void hostCloseWindow(void);

#ifdef __cplusplus
}
#endif

#endif
