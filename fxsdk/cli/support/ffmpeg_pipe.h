/// @file ffmpeg_pipe.h
/// Writes videos through the ffmpeg program, if it is installed. Frames are sent through a pipe. The video
/// file appears when it is complete.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/cli/support/interrupt.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <sys/types.h>

namespace fx::cli {

/// Path of the ffmpeg program in PATH; empty when it is not found.
std::filesystem::path findFfmpeg();

class FfmpegPipe
{
public:
    FfmpegPipe() = default;
    ~FfmpegPipe(); ///< if finish() was not called, stops ffmpeg and removes its output
    FfmpegPipe(const FfmpegPipe&) = delete;
    FfmpegPipe& operator=(const FfmpegPipe&) = delete;

    /// Starts ffmpeg.
    /// @param width, height [pixel] size of every frame; odd sizes are padded by a pixel, because the codec
    ///          requires even sizes
    /// @param framesPerSecond > 0
    /// @return NotFound when ffmpeg is not installed (the message explains how to install it), Io
    base::Status start(const std::filesystem::path& target, int width, int height, double framesPerSecond);

    /// Writes one frame: width * height * 3 bytes, sRGB, rows from the top.
    base::Status write(std::span<const uint8_t> rgb);

    /// Waits for ffmpeg and renames the file to its final name.
    base::Status finish();

private:
    base::Status wait();

    std::filesystem::path target_;
    std::filesystem::path temporary_;
    pid_t process_ = -1;
    EndsWithProgram enteredFile_, enteredProcess_;
    int input_ = -1; ///< file descriptor of the socket to which frames are written
};

} // namespace fx::cli
