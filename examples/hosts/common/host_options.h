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

    /// Number of frames of 1/60 s without a window, 1..100,000; default 95.
    int frames;

    /// [pixel] size of the picture, 16..4096; default 960 x 540.
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

#ifdef __cplusplus
}
#endif

#endif
