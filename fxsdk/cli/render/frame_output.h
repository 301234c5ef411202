/// @file frame_output.h
/// Writes rendered frames to PNG or EXR files or to a video. Incomplete files are removed.
#pragma once

#include "fxsdk/cli/render/frame_renderer.h"
#include "fxsdk/cli/render/render_options.h"

#include <memory>

namespace fx::cli {

class FrameOutput
{
public:
    /// Checks the folder and the ffmpeg program before rendering begins.
    /// @param exposureEv100 exposure of the view, which EXR files state
    static base::Result<std::unique_ptr<FrameOutput>> create(const RenderPlan& plan, float exposureEv100);
    virtual ~FrameOutput() = default;

    virtual base::Status write(int64_t number, const FrameLayers& layers) = 0;
    /// Completes the output after the last frame. A video file appears only after this call.
    virtual base::Status finish() { return {}; }
};

} // namespace fx::cli
