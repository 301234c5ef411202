/// @file view_volume.h
/// The view frustum (or box) as half-spaces in eye space, without a far plane.
#pragma once

#include "rendering/frame/view_block.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace fx::render {

class ViewVolume
{
public:
    explicit ViewVolume(const CameraGeometry& camera) : camera_(camera) {}

    /// True if the sphere may be visible; false if it is certainly outside of the view volume.
    /// @param center [m] position relative to the eye, along world axes
    bool touches(const glm::vec3& center, float radius) const
    {
        const glm::vec3 c(glm::dot(center, camera_.right), glm::dot(center, camera_.up),
                          glm::dot(center, camera_.forward));
        if (c.z + radius < camera_.nearDistance)
            return false;
        for (int axis = 0; axis < 2; ++axis)
            for (const float side : {-1.0f, 1.0f}) {
                const float slope = (side - camera_.clipOffset[axis]) / camera_.clipScale[axis];
                const float outward = camera_.clipScale[axis] < 0.0f ? -side : side; // mirrored
                const float outside = camera_.orthographic ? outward * (c[axis] - slope)
                                                           : outward * (c[axis] - slope * c.z) /
                                                                 std::sqrt(1.0f + slope * slope);
                if (outside > radius)
                    return false;
            }
        return true;
    }

private:
    const CameraGeometry& camera_;
};

} // namespace fx::render
