/// @file hello_window.h
/// What a game brings along: a window, a camera and a picture to draw effects into. Without a display, a
/// file.
#ifndef HELLO_WINDOW_H
#define HELLO_WINDOW_H

#include "fxsdk/fx_view.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct HelloWindow HelloWindow;

/// Opens a window, or with --headless [--frames N] [--output FILE.png] none: then N frames of 1/60 s are
/// drawn and the last is written. @return null when that is not possible; the reason is on the error stream
HelloWindow* helloOpen(int argumentCount, char** arguments);

/// Finds OpenGL functions. @param user the window
void* helloGetProcAddress(void* user, const char* name);

/// Handles events, paints an evening sky and sets the frame's camera, target and deltaTime.
/// @return 0 when it is time to stop
int helloBeginFrame(HelloWindow* window, FxFrameDef* ioFrame);

/// Shows the frame.
void helloEndFrame(HelloWindow* window);

/// Writes the file when there is one to write, and closes. @return exit code
int helloClose(HelloWindow* window);

/// Prints `message`. @return the exit code of failure
int helloFail(const char* message);

#ifdef __cplusplus
}
#endif

#endif
