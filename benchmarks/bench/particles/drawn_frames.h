/// @file drawn_frames.h
/// Plays frames of a scene with a view and times their parts: the same for every measurement that draws
/// particles.
#pragma once

#include "benchmarks/scenes/bench_scene.h"

#include <cstdint>
#include <vector>

namespace fx::cli {

/// How frames are played and timed.
struct FramePlan
{
    double (*now)() = nullptr; ///< [s] one of clocks.h
    uint32_t warmSteps = 0;    ///< updates without drawing, before the first frame
    uint32_t warmFrames = 0;   ///< drawn and not timed: they fill pools
    uint32_t frames = 0;       ///< drawn and timed
    bool isCleared = false;    ///< the picture is black before each frame; otherwise frames add up
};

/// One element a timed frame. A snapshot goes to the GPU once, so each step is drawn twice: the first drawing
/// is that of a host, and its additional time over the second is the upload.
struct FrameTimes
{
    std::vector<double> update;        ///< [s] of the scene
    std::vector<double> upload;        ///< [s] first drawing minus second, at least 0
    std::vector<double> submit;        ///< [s] second drawing
    std::vector<double> finish;        ///< [s] from the end of the first drawing until the GPU has finished
    std::vector<double> calls;         ///< [s] update and first drawing
    std::vector<double> whole;         ///< [s] update, first drawing and finish
    std::vector<double> uploadedBytes; ///< [byte] by the first drawing
    FxViewStatistics view{};           ///< of the last first drawing
};

/// @param outTimes replaced; on failure the times so far
/// @return the first error of the scene; Interrupted after a signal
base::Status playFrames(BenchScene& scene, const FramePlan& plan, FrameTimes& outTimes);

/// [ms] the median of `seconds`.
double medianMilliseconds(const std::vector<double>& seconds);

} // namespace fx::cli
