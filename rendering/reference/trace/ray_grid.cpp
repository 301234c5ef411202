#include "rendering/reference/trace/ray_grid.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

constexpr double kRim = 1e-3; ///< [pixel] by which a rectangle is widened: its own border is inside

/// The plane that holds the rays of one side of a rectangle.
/// @param along change of position and direction from one ray of that side to the next
TileFrustum::Plane sidePlane(const TraceRay& onSide, const glm::dvec3& along, const glm::dvec3& inside)
{
    TileFrustum::Plane plane;
    plane.normal = glm::normalize(glm::cross(onSide.direction, along));
    if (glm::dot(plane.normal, inside - onSide.origin) < 0.0)
        plane.normal = -plane.normal;
    plane.offset = -glm::dot(plane.normal, onSide.origin);
    return plane;
}

} // namespace

TraceRay RayGrid::ray(double x, double y, double* outLengthPerDepth) const
{
    const glm::dvec3 d = direction + x * directionX + y * directionY;
    const double length = glm::length(d);
    if (outLengthPerDepth)
        *outLengthPerDepth = length;
    return {origin + x * originX + y * originY, d / length};
}

TileFrustum frustumOf(const RayGrid& grid, const PixelRect& rect, double farthest)
{
    const double x0 = rect.x0 - kRim;
    const double y0 = rect.y0 - kRim;
    const double x1 = rect.x1 + kRim;
    const double y1 = rect.y1 + kRim;
    const TraceRay middle = grid.ray(0.5 * (x0 + x1), 0.5 * (y0 + y1));
    const glm::dvec3 right = grid.originX + grid.directionX;
    const glm::dvec3 down = grid.originY + grid.directionY;
    const glm::dvec3 inside = middle.origin + middle.direction;

    TileFrustum frustum;
    frustum.planes[0] = sidePlane(grid.ray(x0, y0), down, inside);
    frustum.planes[1] = sidePlane(grid.ray(x1, y0), down, inside);
    frustum.planes[2] = sidePlane(grid.ray(x0, y0), right, inside);
    frustum.planes[3] = sidePlane(grid.ray(x0, y1), right, inside);
    // Rays of a picture all lead forwards, so a plane across the middle one bounds their beginning, and none
    // gets farther along it than its own length.
    const double start = glm::dot(middle.direction, middle.origin);
    const double slack = 1e-9 * (1.0 + std::abs(start));
    frustum.planes[4] = {middle.direction, slack - start};
    const double end = std::min(farthest, 1e30) * (1.0 + 1e-12);
    frustum.planes[5] = {-middle.direction, slack + start + end};
    return frustum;
}

} // namespace fx::render
