/// @file stage_camera.h
/// Camera matrices for tools and tests.
#pragma once

#include "rendering/frame/view_types.h"

#include <glm/vec3.hpp>

namespace fx::render {

/// Position and target of a camera, in world coordinates.
struct CameraPose
{
    glm::dvec3 position{0.0, 2.0, 10.0}; ///< [m]
    glm::dvec3 target{0.0};              ///< [m] different from position
    /// Upward direction. The direction must not be parallel to the view axis. It need not be perpendicular to
    /// the view axis.
    glm::vec3 up{0.0f, 1.0f, 0.0f};
};

/// A camera whose matrices are relative to its position, with an infinite far plane.
/// @param fovY [rad] vertical angle of view
/// @param aspect width / height
/// @param nearDistance [m] > 0
CameraView perspectiveView(const CameraPose& pose, float fovY, float aspect, float nearDistance,
                           DepthConvention depth = DepthConvention::Standard);

/// A camera with parallel projection of a region of `height` [m], from nearDistance to farDistance [m].
CameraView orthographicView(const CameraPose& pose, float height, float aspect, float nearDistance,
                            float farDistance);

} // namespace fx::render
