/// @file ball_window.h
/// Computes the rectangle of the window that a ball covers. shaders/shared/blob_quad.glsl draws the same
/// rectangle, before clipping.
#pragma once

#include "rendering/frame/view_block.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fx::render {

/// [pixel] Least radius with which blobs are drawn. With this radius, the sum of the pixel values differs
/// from the light of the blob by at most 6 %.
inline constexpr float kMinPixels = 1.15f;

/// Slopes of the two tangents from the eye to a ball, in the plane of one screen axis and the view axis. The
/// slopes are limited to +-1e9. blob_quad.glsl has an equal function.
/// @param c, depth [m] coordinates of the center along the screen axis and along the view axis
inline std::pair<float, float> tangentSlopes(float c, float depth, float radius)
{
    constexpr float kAll = 1e9f;
    const float l2 = c * c + depth * depth - radius * radius;
    if (l2 <= 0.0f)
        return {-kAll, kAll};
    const float l = std::sqrt(l2);
    const float lowDepth = depth * l + c * radius;
    const float highDepth = depth * l - c * radius;
    return {lowDepth > 0.0f ? (c * l - depth * radius) / lowDepth : -kAll,
            highDepth > 0.0f ? (c * l + depth * radius) / highDepth : kAll};
}

/// Range of clip coordinates of a ball along one screen axis, as least and greatest coordinate.
/// @param c, depth [m] coordinates of the center along the screen axis and along the view axis
inline std::pair<float, float> clipRange(const CameraGeometry& camera, int axis, float c, float depth,
                                         float radius)
{
    const auto [low, high] =
        camera.orthographic ? std::pair(c - radius, c + radius) : tangentSlopes(c, depth, radius);
    const float a = low * camera.clipScale[axis] + camera.clipOffset[axis];
    const float b = high * camera.clipScale[axis] + camera.clipOffset[axis];
    return {std::min(a, b), std::max(a, b)};
}

} // namespace fx::render
