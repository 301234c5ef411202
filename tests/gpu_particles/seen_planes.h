/// @file seen_planes.h
/// Creates depth textures of planes with the values that a rasterizer writes, and computes their resolution.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/stage/stage_camera.h"

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

namespace fx::test {

/// A plane of the world points p with dot(normal, p) = offset. The plane is visible from the side to which
/// the normal points.
struct SeenPlane
{
    glm::dvec3 normal; ///< unit vector
    double offset;     ///< [m]
    /// Returns true if the plane exists at a position; empty: the plane exists everywhere.
    std::function<bool(const glm::dvec3& place)> isThere = {};
};

/// The ray through the center of a pixel: from + s way.
struct PixelRay
{
    glm::dvec3 from, way;
};

/// Ray of a position in the picture. The ray is computed only from the matrices of the camera, independently
/// of the tested code.
inline PixelRay rayOf(const render::CameraView& camera, int width, int height, double x, double y)
{
    const glm::dmat4 back = glm::inverse(glm::dmat4(camera.projection) * glm::dmat4(camera.view));
    const double flip = camera.upperLeftOrigin ? -1.0 : 1.0;
    const double u = 2.0 * x / width - 1.0, v = flip * (2.0 * y / height - 1.0);
    const auto at = [&](double clip) {
        const glm::dvec4 p = back * glm::dvec4(u, v, clip, 1.0);
        return camera.origin + glm::dvec3(p) / p.w;
    };
    const bool isReversed = camera.depth == render::DepthConvention::Reversed;
    const glm::dvec3 near = at(isReversed ? 1.0 : (camera.zeroToOne ? 0.0 : -1.0));
    const glm::dvec3 farther = at(isReversed ? 0.5 : 0.5);
    return {near, farther - near};
}

/// Depth value that is stored for a world position.
inline double storedDepth(const render::CameraView& camera, const glm::dvec3& place)
{
    const glm::dvec4 clip =
        glm::dmat4(camera.projection) * glm::dmat4(camera.view) * glm::dvec4(place - camera.origin, 1.0);
    const double n = clip.z / clip.w;
    return camera.zeroToOne ? n : 0.5 * (n + 1.0);
}

/// Depth of the nearest plane in each pixel, row by row from the first row of the texture.
inline std::vector<float> depthOf(const render::CameraView& camera, int width, int height,
                                  const std::vector<SeenPlane>& planes)
{
    const float nothing = camera.depth == render::DepthConvention::Reversed ? 0.0f : 1.0f;
    std::vector<float> stored(size_t(width) * size_t(height), nothing);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const PixelRay ray = rayOf(camera, width, height, x + 0.5, y + 0.5);
            double nearest = std::numeric_limits<double>::infinity();
            for (const SeenPlane& plane : planes) {
                const double along = glm::dot(plane.normal, ray.way);
                const double s = (plane.offset - glm::dot(plane.normal, ray.from)) / along;
                if (along < 0.0 && s > 0.0 && (!plane.isThere || plane.isThere(ray.from + s * ray.way)))
                    nearest = std::min(nearest, s);
            }
            if (nearest < 1e6)
                stored[size_t(y) * size_t(width) + size_t(x)] =
                    float(storedDepth(camera, ray.from + nearest * ray.way));
        }
    return stored;
}

/// Resolution of a depth texture at a distance along the axis.
struct DepthResolution
{
    double texture; ///< [m] distance of two neighboring depth values, including the rounding of float
    double error;   ///< [m] distance of two neighboring depth values with 24 bits, symbol e of formula
                    ///< depth-contact
    double pixel;   ///< [m] symbol f of formula depth-contact
};

inline DepthResolution resolutionAt(const render::CameraView& camera, int height, double distance)
{
    constexpr double kUlp = 0x1p-23; // of n, of which half are stored
    const glm::dmat4 p(camera.projection);
    const double step = (camera.zeroToOne ? 1.0 : 2.0) * 0x1p-24, floats = 4.0 * kUlp * distance;
    if (p[3][3] != 0.0) {
        const double error = step / std::abs(p[2][2]) + floats;
        return {error, error, 2.0 / (p[1][1] * height)};
    }
    const double error = step * distance * distance / std::abs(p[3][2]) + floats;
    const bool isReversed = camera.depth == render::DepthConvention::Reversed;
    return {isReversed ? floats : error, error, 2.0 * distance / (p[1][1] * height)};
}

} // namespace fx::test
