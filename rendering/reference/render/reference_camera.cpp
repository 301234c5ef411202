#include "rendering/reference/render/reference_camera.h"

#include <glm/geometric.hpp>

namespace fx::render {

ReferenceCamera ReferenceCamera::lookAt(const glm::dvec3& position, const glm::dvec3& target,
                                        const glm::dvec3& upwards)
{
    ReferenceCamera camera;
    camera.eye = position;
    camera.forward = glm::normalize(target - position);
    camera.right = glm::normalize(glm::cross(camera.forward, upwards));
    camera.up = glm::cross(camera.right, camera.forward);
    return camera;
}

RayGrid ReferenceCamera::grid(int width, int height) const
{
    const double pixel = 2.0 * halfHeight / height;
    const glm::dvec3 perX = right * pixel;
    const glm::dvec3 perY = up * -pixel;
    const glm::dvec3 corner = perX * (-0.5 * width) + perY * (-0.5 * height);
    RayGrid grid;
    if (orthographic) {
        grid.origin = corner;
        grid.originX = perX;
        grid.originY = perY;
        grid.direction = forward;
    } else {
        grid.direction = forward + corner;
        grid.directionX = perX;
        grid.directionY = perY;
    }
    return grid;
}

} // namespace fx::render
