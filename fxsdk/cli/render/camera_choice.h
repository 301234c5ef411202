/// @file camera_choice.h
/// The camera that command-line options set instead of the scene's camera.
#pragma once

#include "fxsdk/cli/render/reference_options.h"
#include "fxsdk/scene_file/camera_path.h"

#include <optional>

namespace fx::cli {

/// The camera of --view or --camera; none without these options.
class CameraChoice
{
public:
    /// Evaluates the options --view and --camera.
    /// @param plan contains the camera of --view
    /// @return the error of reading the file of --camera
    static base::Result<CameraChoice> create(const ReferenceArguments& arguments, const ReferencePlan& plan);

    bool isNone() const { return !fixed_ && !path_; }
    /// The chosen camera at a time.
    /// @param time [s] scene time
    /// @param otherwise camera that is returned if no option sets one
    render::ReferenceCamera at(double time, const render::ReferenceCamera& otherwise = {}) const;

private:
    std::optional<render::ReferenceCamera> fixed_;
    std::optional<scene_file::CameraPath> path_;
};

/// Replaces the camera of a scene by that of --view or --camera, if one of the options is given. With --view,
/// the near plane of the scene does not change.
/// @return InvalidArgument for a malformed --view, or the error of the file of --camera. On failure `io` does
/// not change.
base::Status replaceCamera(const ReferenceArguments& arguments, scene_file::CameraPath& io);

} // namespace fx::cli
