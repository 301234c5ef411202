/// @file view_block.h
/// The uniform block for all passes of a view: rays of pixels, camera axes, constants to linearize depth.
#pragma once

#include "rendering/frame/view_types.h"

#include <glm/vec4.hpp>

namespace fx::render {

/// Layout of ViewBlock in shaders/shared/view_block.glsl, where each member is explained.
struct ViewBlock
{
    glm::vec4 rayOrigin;
    glm::vec4 rayOriginX;
    glm::vec4 rayOriginY;
    glm::vec4 rayDirection;
    glm::vec4 rayDirectionX;
    glm::vec4 rayDirectionY;
    glm::vec4 right;
    glm::vec4 up;
    glm::vec4 forward;
    glm::vec4 clipOffset;
    glm::vec4 depthScale;
    glm::vec4 depthRange;
    glm::vec4 sunDirection;
    glm::vec4 pass;
};
static_assert(sizeof(ViewBlock) == 14 * 16);

/// Geometry of a camera.
struct CameraGeometry
{
    glm::dvec3 eye;               ///< [m] world
    glm::vec3 right, up, forward; ///< unit vectors along world axes
    bool orthographic;
    float nearDistance; ///< [m] distance of the near plane along the view axis
    /// Change of the clip coordinates x, y per unit of slope (perspective) or per meter (orthographic).
    glm::vec2 clipScale;
    glm::vec2 clipOffset; ///< clip coordinates x, y of the view axis
};

CameraGeometry cameraGeometry(const CameraView& camera);

/// @param width, height [pixel] size of the target
ViewBlock makeViewBlock(const CameraView& camera, int width, int height);

} // namespace fx::render
