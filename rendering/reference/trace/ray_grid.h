/// @file ray_grid.h
/// The rays of a picture, and the part of space that the rays of a rectangle of pixels can reach.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace fx::render {

/// A ray. Its parameter is the distance from the origin. The ray and the tree through which it is traced use
/// the same coordinates.
struct TraceRay
{
    glm::dvec3 origin;    ///< [m]
    glm::dvec3 direction; ///< unit vector
};

/// A rectangle of pixels, or of positions in the picture: pixel (i, j) covers [i, i + 1) x [j, j + 1).
struct PixelRect
{
    double x0, y0, x1, y1;
};

/// All rays of a perspective or orthographic picture. Row 0 is at the top.
struct RayGrid
{
    glm::dvec3 origin{0.0};  ///< [m] origin of the ray through the corner (0, 0)
    glm::dvec3 originX{0.0}; ///< [m] change of origin per pixel to the right
    glm::dvec3 originY{0.0}; ///< [m] change of origin per pixel down
    /// Direction of the ray through (0, 0), not normalized: its component along the view axis is 1.
    glm::dvec3 direction{0.0};
    glm::dvec3 directionX{0.0}; ///< change of direction per pixel to the right
    glm::dvec3 directionY{0.0}; ///< change of direction per pixel down

    /// The ray through position (x, y).
    /// @param outLengthPerDepth receives the ray parameter divided by the distance along the view axis
    TraceRay ray(double x, double y, double* outLengthPerDepth = nullptr) const;
};

/// Half-spaces n . x + d >= 0 whose intersection contains all points of the rays through a rectangle.
struct TileFrustum
{
    struct Plane
    {
        glm::dvec3 normal{0.0}; ///< unit vector that points inwards
        double offset = 0.0;    ///< [m]
    };
    static constexpr uint32_t kPlanes = 6;
    std::array<Plane, kPlanes> planes; ///< the half-spaces left, right, top, bottom, near, far
};

/// The half-spaces that contain the rays through a rectangle.
/// @param farthest [m] ray parameter beyond which hits are ignored; may be +inf
TileFrustum frustumOf(const RayGrid& grid, const PixelRect& rect, double farthest);

} // namespace fx::render
