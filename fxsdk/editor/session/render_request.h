/// @file render_request.h
/// What the button "Render" writes.
#pragma once

#include <string>

namespace fx::editor {

enum class RenderKind
{
    Picture,   ///< the present moment
    Sequence,  ///< numbered PNG files of the whole timeline
    Turntable, ///< the present moment from all around
    Video      ///< MP4 of the whole timeline
};

struct RenderRequest
{
    RenderKind kind = RenderKind::Picture;
    /// NAME.png; of a sequence with a placeholder such as NAME.%04d.png; of turntable and video also
    /// NAME.mp4.
    std::string file = "picture.png";
    int width = 1280;              ///< [pixel]
    int height = 720;              ///< [pixel]
    double framesPerSecond = 30.0; ///< > 0
    int turnFrames = 90;           ///< of a turntable
};

} // namespace fx::editor
