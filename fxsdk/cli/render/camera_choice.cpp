#include "fxsdk/cli/render/camera_choice.h"

#include "fxsdk/cli/render/reference_scene.h"

namespace fx::cli {

base::Result<CameraChoice> CameraChoice::create(const ReferenceArguments& arguments,
                                                const ReferencePlan& plan)
{
    CameraChoice choice;
    choice.fixed_ = plan.camera;
    if (arguments.camera.empty())
        return choice;
    auto file = scene_file::loadSceneFile(arguments.camera);
    if (!file.ok())
        return file.status();
    choice.path_ = file->camera;
    return choice;
}

render::ReferenceCamera CameraChoice::at(double time, const render::ReferenceCamera& otherwise) const
{
    if (fixed_)
        return *fixed_;
    return path_ ? cameraOf(*path_, time) : otherwise;
}

} // namespace fx::cli
