/// @file camera_choice.h
/// The camera that options name in place of the scene's.
#pragma once

#include "fxsdk/cli/render/reference_options.h"
#include "fxsdk/scene_file/camera_path.h"

#include <optional>

namespace fx::cli {

/// The camera chosen by --view or --camera, or none.
class CameraChoice
{
public:
    /// @param plan with the camera of --view
    /// @return the error of the file of --camera
    static base::Result<CameraChoice> create(const ReferenceArguments& arguments, const ReferencePlan& plan);

    bool isNone() const { return !fixed_ && !path_; }
    /// @param time [s]  @param otherwise if no option names a camera
    render::ReferenceCamera at(double time, const render::ReferenceCamera& otherwise = {}) const;

private:
    std::optional<render::ReferenceCamera> fixed_;
    std::optional<scene_file::CameraPath> path_;
};

} // namespace fx::cli
