/// @file reference_camera.h
/// The camera of the reference renderer, in double precision.
#pragma once

#include "rendering/reference/trace/ray_grid.h"

#include <glm/vec3.hpp>

namespace fx::render {

struct ReferenceCamera
{
    glm::dvec3 eye{0.0};                ///< [m] position of the eye in the world
    glm::dvec3 right{1.0, 0.0, 0.0};    ///< unit vector
    glm::dvec3 up{0.0, 1.0, 0.0};       ///< unit vector
    glm::dvec3 forward{0.0, 0.0, -1.0}; ///< unit vector
    bool orthographic = false;
    /// Half of the picture's height: the tangent of half the angle of view; or, if orthographic, a length
    /// [m].
    double halfHeight = 0.5;
    double nearDistance = 0.1; ///< [m] distance of the near plane along the view axis, >= 0

    /// A camera at `position` that looks to `target`. The two points must differ, and `upwards` must not be
    /// parallel to the view axis.
    static ReferenceCamera lookAt(const glm::dvec3& position, const glm::dvec3& target,
                                  const glm::dvec3& upwards);

    /// The rays of a picture with square pixels, relative to the eye.
    RayGrid grid(int width, int height) const;
};

} // namespace fx::render
