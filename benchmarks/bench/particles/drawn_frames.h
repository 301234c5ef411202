/// @file drawn_frames.h
/// Plays frames of a scene with a view and times their parts. Shared by all measurements that draw particles.
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
    uint32_t warmFrames = 0;   ///< frames drawn without timing, to fill pools
    uint32_t frames = 0;       ///< frames drawn and timed
    /// True: the picture is black before each frame; false: frames are drawn over each other
    bool isCleared = false;
};

/// One element per timed frame. A snapshot is uploaded to the GPU once, so each step is drawn twice. The
/// first drawing is that of a host; its additional time over the second is the time of the upload.
struct FrameTimes
{
    std::vector<double> update;        ///< [s] update of the scene
    std::vector<double> upload;        ///< [s] first drawing minus second, at least 0
    std::vector<double> submit;        ///< [s] second drawing
    std::vector<double> finish;        ///< [s] from the end of the first drawing until the GPU has finished
    std::vector<double> calls;         ///< [s] update and first drawing
    std::vector<double> whole;         ///< [s] update, first drawing and finish
    std::vector<double> uploadedBytes; ///< [byte] uploaded by the first drawing
    FxViewStatistics view{};           ///< of the last frame's first drawing
};

/// @param outTimes is replaced; on failure it contains the times measured so far
/// @return the first error of the scene; Interrupted after a signal
base::Status playFrames(BenchScene& scene, const FramePlan& plan, FrameTimes& outTimes);

/// [ms] Median of `seconds`.
double medianMilliseconds(const std::vector<double>& seconds);

} // namespace fx::cli
