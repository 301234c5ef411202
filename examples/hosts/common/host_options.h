/// @file host_options.h
/// Command line of the example hosts.
///
/// Threads: the main thread.
#ifndef HOST_OPTIONS_H
#define HOST_OPTIONS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct HostOptions
{
    /// PNG file that receives the last frame; null: frames are shown in a window until it is closed.
    const char* output;

    /// Number of frames, 1..100,000; default 95 without a window. 0 in a window, the default: until it is
    /// closed.
    int frames;

    /// [pixel] size of the picture, 16..4096; default 960 x 540. A window may have more pixels, on displays
    /// that scale: hosts then set the size of its framebuffer.
    int width, height;

    /// 1: the view leaves its GL state behind and the host restores its own (host sdl2); default 0.
    int hostRestores;
} HostOptions;

/// Reads [--headless FILE.png] [--frames N] [--size WxH] [--host-restores].
/// @return 1; 0 after printing what is wrong and how the program is used
int hostParse(int argumentCount, char** arguments, HostOptions* outOptions);

/// Whether frame number `frame` is drawn: all frames of a window, the last four without one. The frames
/// before are only simulated.
int hostDraws(const HostOptions* options, int frame);

/// Whether frame number `frame` is still to be played, as far as the command line limits frames.
int hostPlays(const HostOptions* options, int frame);

/// [s] time by which the effects advance in the next frame. In a window this is the time since the previous
/// call, whatever the rate of the display, but at most 0.1 s: a game that was stopped goes on where it was.
/// It is 0 in the first call, and always 1/60 without a window, so that pictures repeat.
double hostStep(const HostOptions* options);

#ifdef __cplusplus
}
#endif

#endif
