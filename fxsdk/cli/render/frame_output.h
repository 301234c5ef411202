/// @file frame_output.h
/// Puts rendered frames into files: PNG, EXR or a video. Every file is complete or not there.
#pragma once

#include "fxsdk/cli/render/frame_renderer.h"
#include "fxsdk/cli/render/render_options.h"

#include <memory>

namespace fx::cli {

class FrameOutput
{
public:
    /// Checks what can be checked before the work begins: the folder, the ffmpeg program.
    /// @param exposureEv100 of the view, noted in EXR files
    static base::Result<std::unique_ptr<FrameOutput>> create(const RenderPlan& plan, float exposureEv100);
    virtual ~FrameOutput() = default;

    virtual base::Status write(int64_t number, const FrameLayers& layers) = 0;
    /// After the last frame. Without it a video is not put in place.
    virtual base::Status finish() { return {}; }
};

} // namespace fx::cli
