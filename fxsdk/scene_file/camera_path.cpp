#include "fxsdk/scene_file/camera_path.h"

#include "fxsdk/scene_file/key_interpolation.h"

#include <glm/gtc/matrix_transform.hpp>

namespace fx::scene_file {

CameraPose CameraPath::at(double time) const
{
    if (keys.empty())
        return {position, target};
    return {smoothAt(keys, time, &CameraKey::position), smoothAt(keys, time, &CameraKey::target)};
}

glm::mat4 CameraPath::viewRotation(double time) const
{
    const CameraPose pose = at(time);
    const glm::vec3 forward(glm::normalize(pose.target - pose.position));
    return glm::lookAt(glm::vec3(0.0f), forward, up);
}

glm::mat4 CameraPath::projection(float aspect) const
{
    constexpr float kOrthographicFar = 10'000.0f;
    if (orthographicHeight > 0) {
        const float halfHeight = 0.5f * orthographicHeight;
        return glm::ortho(-aspect * halfHeight, aspect * halfHeight, -halfHeight, halfHeight, nearPlane,
                          kOrthographicFar);
    }
    return glm::infinitePerspective(glm::radians(fovYDegrees), aspect, nearPlane);
}

} // namespace fx::scene_file
