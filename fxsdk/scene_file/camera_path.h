/// @file camera_path.h
/// The camera of a scene, which is fixed or moves smoothly through keys.
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

/// Camera and its motion. Key times increase. The camera does not move before the first key and after the
/// last key.
struct CameraPath
{
    glm::dvec3 position{0, 2, 12}; ///< [m] position of a camera without keys
    glm::dvec3 target{0, 2, 0};    ///< [m] target of a camera without keys
    glm::vec3 up{0, 1, 0};
    float fovYDegrees = 50;       ///< [degree] vertical field of view, used if orthographicHeight is 0
    float orthographicHeight = 0; ///< [m] height of the picture of an orthographic camera; 0: perspective
    float nearPlane = 0.1f;       ///< [m] > 0
    std::vector<CameraKey> keys;

    /// Returns position and target at `time` [s]. Keys are interpolated by cubic Hermite segments with
    /// Catmull-Rom tangents for nonuniform times, so velocity is continuous.
    CameraPose at(double time) const;

    /// Returns the rotation from world axes to eye axes. The origin must be the camera's position.
    glm::mat4 viewRotation(double time) const;
    /// Returns the matrix from eye space to clip space, with z in [-w, w] (OpenGL convention). The far plane
    /// is infinite for perspective cameras, and at 10 km for orthographic cameras.
    glm::mat4 projection(float aspect) const;
};

} // namespace fx::scene_file
