#include "rendering/stage/stage_camera.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

#include <cmath>

namespace fx::render {

namespace {

CameraView viewAt(const CameraPose& pose)
{
    CameraView view;
    view.origin = pose.position;
    view.view = glm::mat4(glm::lookAt(glm::dvec3(0.0), pose.target - pose.position, glm::dvec3(pose.up)));
    return view;
}

} // namespace

CameraView perspectiveView(const CameraPose& pose, float fovY, float aspect, float nearDistance,
                           DepthConvention depth)
{
    CameraView view = viewAt(pose);
    const float f = 1.0f / std::tan(0.5f * fovY);
    glm::mat4 p(0.0f);
    p[0][0] = f / aspect;
    p[1][1] = f;
    p[2][3] = -1.0f;
    if (depth == DepthConvention::Reversed) { // depth = near / distance in [0, 1]
        p[3][2] = nearDistance;
        view.zeroToOne = true;
    } else { // clip depth = 1 - 2 near / distance in [-1, 1]
        p[2][2] = -1.0f;
        p[3][2] = -2.0f * nearDistance;
    }
    view.projection = p;
    view.depth = depth;
    return view;
}

CameraView orthographicView(const CameraPose& pose, float height, float aspect, float nearDistance,
                            float farDistance)
{
    CameraView view = viewAt(pose);
    const float y = 0.5f * height;
    view.projection = glm::orthoRH_NO(-y * aspect, y * aspect, -y, y, nearDistance, farDistance);
    return view;
}

} // namespace fx::render
