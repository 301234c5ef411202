/// @file hello_window.h
/// The parts of a host: a window, a camera, and a picture into which effects are drawn. Without a display,
/// the picture is written to a file.
#ifndef HELLO_WINDOW_H
#define HELLO_WINDOW_H

#include "fxsdk/fx_view.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct HelloWindow HelloWindow;

/// Opens a window. With --headless [--frames N] [--output FILE.png], no window is opened: N frames of 1/60 s
/// are drawn, and the last frame is written. @return null on failure; the reason is printed to the error
/// stream
HelloWindow* helloOpen(int argumentCount, char** arguments);

/// Finds OpenGL functions. @param user the window
void* helloGetProcAddress(void* user, const char* name);

/// Handles events, paints an evening sky and sets the frame's camera, target and deltaTime.
/// @return 0 when the program has to end
int helloBeginFrame(HelloWindow* window, FxFrameDef* ioFrame);

/// Shows the frame.
void helloEndFrame(HelloWindow* window);

/// Writes the file if --output is given, and closes the window. @return exit code
int helloClose(HelloWindow* window);

/// Prints `message`. @return the exit code of failure
int helloFail(const char* message);

#ifdef __cplusplus
}
#endif

#endif
