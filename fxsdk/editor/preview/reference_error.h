/// @file reference_error.h
/// The difference of a picture from that of the reference renderer, computed beside the editor.
///
/// Threads: one at a time; an object runs a thread of its own until it is done, stopped or destroyed.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/editor/preview/preview.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace fx::editor {

/// Absolute differences of the exposed luminance; 1 is the white of the picture. Brighter than white counts
/// as white, as on the screen.
struct ErrorPicture
{
    int width = 0;             ///< [pixel]
    int height = 0;            ///< [pixel]
    std::vector<float> errors; ///< by rows from the top
    double mean = 0.0;
    double p99 = 0.0; ///< 99 of 100 pixels have at most this
    double largest = 0.0;
    size_t notFinite = 0; ///< pixels of which a color is infinite or not a number; their error counts as 1
};

/// @param picture, reference RGB, exposed, by rows from the top, of equal sizes
ErrorPicture errorOf(const std::vector<float>& picture, const std::vector<float>& reference, int width,
                     int height);

/// RGBA with 8 bits for a screen: black 0, blue 0.01, magenta 0.03, orange 0.1, yellow 0.3, white 1.
std::vector<uint8_t> errorColors(const ErrorPicture& error);

class ReferenceRun
{
public:
    /// Begins.
    /// @param scene   is copied
    /// @param time    [s] scene time
    /// @param frame   camera, size and exposure of the picture
    /// @param picture RGB of Preview::render() with PreviewFrame::isLinear, by rows from the top
    ReferenceRun(const scene_file::SceneFile& scene, double time, const PreviewFrame& frame,
                 std::vector<float> picture);
    ~ReferenceRun(); ///< stops and waits
    ReferenceRun(const ReferenceRun&) = delete;
    ReferenceRun& operator=(const ReferenceRun&) = delete;

    double progress() const { return progress_; } ///< [0, 1] simulation is the first tenth
    bool isDone() const { return isDone_; }
    /// Ends at the next ray or step; the result is then Interrupted.
    void stop() { isStopped_ = true; }
    /// The result, once isDone(). @return Interrupted, or the error of the simulation
    const base::Result<ErrorPicture>& result();

private:
    void run();
    base::Result<ErrorPicture> compute();

    scene_file::SceneFile scene_;
    double time_;
    PreviewFrame frame_;
    std::vector<float> picture_;
    std::atomic<double> progress_{0.0};
    std::atomic<bool> isStopped_{false};
    std::atomic<bool> isDone_{false};
    std::optional<base::Result<ErrorPicture>> result_;
    std::thread thread_;
};

} // namespace fx::editor
