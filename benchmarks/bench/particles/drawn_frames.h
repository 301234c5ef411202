/// @file drawn_frames.h
/// Plays frames of a scene with a view and times their parts. All measurements that draw particles use this
/// code.
#pragma once

#include "benchmarks/scenes/bench_scene.h"

#include <cstdint>
#include <vector>

namespace fx::cli {

/// How frames are played and timed.
struct FramePlan
{
    double (*now)() = nullptr; ///< [s] clock, one of the functions of clocks.h
    uint32_t warmSteps = 0;    ///< updates without drawing, before the first frame
    uint32_t warmFrames = 0;   ///< frames drawn without timing, to fill pools
    uint32_t frames = 0;       ///< frames drawn and timed
    /// True: the picture is black before each frame; false: frames are drawn over each other
    bool isCleared = false;
};

/// Times of the timed frames, one element per frame. A snapshot is uploaded to the GPU once. Therefore each
/// step is drawn twice: the first drawing includes the upload, as in a host, and the second does not. The
/// difference is the time of the upload.
struct FrameTimes
{
    std::vector<double> update;        ///< [s] update of the scene
    std::vector<double> upload;        ///< [s] time of the first drawing minus time of the second
    std::vector<double> submit;        ///< [s] time of the second drawing
    std::vector<double> finish;        ///< [s] from the end of the first drawing until the GPU has finished
    std::vector<double> calls;         ///< [s] sum of the update and the first drawing
    std::vector<double> whole;         ///< [s] sum of the update, the first drawing and `finish`
    std::vector<double> uploadedBytes; ///< [byte] data that the first drawing uploaded
    FxViewStatistics view{};           ///< statistics of the first drawing of the last frame
};

/// Plays and times the frames of `plan`.
/// @param outTimes is replaced; on failure it contains the times measured so far
/// @return the first error of the scene; Interrupted after a signal
base::Status playFrames(BenchScene& scene, const FramePlan& plan, FrameTimes& outTimes);

/// [ms] Median of `seconds`.
double medianMilliseconds(const std::vector<double>& seconds);

} // namespace fx::cli
