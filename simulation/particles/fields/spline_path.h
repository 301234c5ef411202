/// @file spline_path.h
/// A smooth curve through points, parametrized by arc length.
///
/// @formula spline-by-arc-length
/// A cubic spline through given points, and the point at a given share of its length.
///
/// symbol   unit   meaning
///   Pi       m      the points
///   s        1      position within a segment, 0..1
///   p, p'    m      point of the curve and its derivative by s
///   L(s)     m      length of the curve up to s
/// @derivation
///   between P1 and P2, with P0 before and P3 after (beyond an open end, the mirror image of the next point),
///   p = P1 + s/2 ((P2 - P0) + s ((2 P0 - 5 P1 + 4 P2 - P3) + s (3 (P1 - P2) + P3 - P0)))       (1)
///   L = integral of |p'| ds, by two-point Gauss quadrature on 32 pieces of each segment       (2)
///   The table of L at the ends of the pieces is inverted linearly, then by one Newton step
///       s <- s - (L(s) - l) / |p'|                                                            (3)
/// @source    [CR74] for (1); the rest is elementary
/// @deviation none
/// @valid     2 to 256 points; a segment between coincident points has no length
/// @accuracy  length within 1e-4 of itself, for curves without cusps
/// @tests     tests/simulation/particles/modules/test_spline_path.cpp
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace fx::sim {

constexpr size_t kMaxSplinePoints = 256;

/// A spline through points. Objects are immutable. [any thread]
class SplinePath
{
public:
    /// Computes a spline through points.
    /// @param points at least two points
    /// @param isClosed true: the last point is joined to the first point
    SplinePath(std::span<const glm::vec3> points, bool isClosed);

    struct Place
    {
        glm::vec3 position; ///< [m]
        glm::vec3 tangent;  ///< unit vector
    };
    /// The point at the arc length u times the total length. @param u 0 <= u < 1
    Place at(float u) const;
    double length() const { return length_.back(); } ///< [m]

private:
    struct Segment
    {
        glm::dvec3 c[4]; ///< coefficients of the polynomial, from s^0 to s^3
    };
    size_t segments() const { return segments_.size(); }
    double speed(size_t segment, double s) const;
    double pieceLength(size_t segment, double from, double to) const;

    std::vector<Segment> segments_;
    std::vector<double> length_; ///< [m] length of the path up to the end of each piece, beginning with 0
};

} // namespace fx::sim
