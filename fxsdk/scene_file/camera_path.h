/// @file camera_path.h
/// The camera of a scene, fixed or moved smoothly through keys.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace fx::scene_file {

struct CameraKey
{
    double time = 0;        ///< [s]
    glm::dvec3 position{0}; ///< [m]
    glm::dvec3 target{0};   ///< [m]
};

/// Camera position and target at one moment.
struct CameraPose
{
    glm::dvec3 position;
    glm::dvec3 target;
};

/// Camera and its motion. Key times increase. Before the first key and after the last the camera stands
/// still.
struct CameraPath
{
    glm::dvec3 position{0, 2, 12}; ///< [m] position of a camera without keys
    glm::dvec3 target{0, 2, 0};    ///< [m] target of a camera without keys
    glm::vec3 up{0, 1, 0};
    float fovYDegrees = 50;       ///< [degree] vertical field of view, used when orthographicHeight is 0
    float orthographicHeight = 0; ///< [m] height of the picture of an orthographic camera; 0: perspective
    float nearPlane = 0.1f;       ///< [m] > 0
    std::vector<CameraKey> keys;

    /// Position and target at `time` [s]: cubic Hermite interpolation through the keys with Catmull-Rom
    /// tangents for nonuniform times, so that velocity is continuous inside the path.
    CameraPose at(double time) const;

    /// Rotation from world to eye. Use it with an origin at the camera's position.
    glm::mat4 viewRotation(double time) const;
    /// Matrix from eye to clip space, OpenGL convention with z in [-w, w]. The far plane is infinite for
    /// perspective cameras and at 10 km for orthographic ones.
    glm::mat4 projection(float aspect) const;
};

} // namespace fx::scene_file
