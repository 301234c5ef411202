#include "fxsdk/cli/render/camera_choice.h"

#include "fxsdk/cli/render/reference_scene.h"

#include <cmath>
#include <numbers>

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

base::Status replaceCamera(const ReferenceArguments& arguments, scene_file::CameraPath& io)
{
    if (!arguments.view.empty()) {
        const auto view = parseView(arguments.view);
        if (!view.ok())
            return view.status();
        scene_file::CameraPath path;
        path.position = view->eye;
        path.target = view->eye + view->forward;
        path.up = glm::vec3(view->up);
        path.fovYDegrees = float(2.0 * std::atan(view->halfHeight) * 180.0 / std::numbers::pi);
        path.nearPlane = io.nearPlane;
        io = path;
    }
    if (!arguments.camera.empty()) {
        auto file = scene_file::loadSceneFile(arguments.camera);
        if (!file.ok())
            return file.status();
        io = file->camera;
    }
    return {};
}

} // namespace fx::cli
