/// @file frame_output.h
/// Writes rendered frames to files: PNG, EXR or a video. Incomplete files are never left behind.
#pragma once

#include "fxsdk/cli/render/frame_renderer.h"
#include "fxsdk/cli/render/render_options.h"

#include <memory>

namespace fx::cli {

class FrameOutput
{
public:
    /// Checks the folder and the ffmpeg program before rendering begins.
    /// @param exposureEv100 of the view, written to EXR files
    static base::Result<std::unique_ptr<FrameOutput>> create(const RenderPlan& plan, float exposureEv100);
    virtual ~FrameOutput() = default;

    virtual base::Status write(int64_t number, const FrameLayers& layers) = 0;
    /// After the last frame. Without it a video is not put in place.
    virtual base::Status finish() { return {}; }
};

} // namespace fx::cli
