/// @file point_triangle.h
/// Distance from a point to a triangle.
///
/// @formula point-triangle-distance
/// The point of a triangle nearest to a given point, by the region that the point's projection lies in.
///
/// symbol      unit   meaning
///   a, b, c    m      corners
///   p          m      the point
///   d1 .. d6   m2     scalar products of the sides with vectors from a corner to p
///   va, vb, vc m4     barycentric coordinates of the projection, not normalized
/// @derivation
///   d1 = ab.ap, d2 = ac.ap; d1 <= 0 and d2 <= 0: a is nearest                              (1)
///   d3 = ab.bp, d4 = ac.bp; d3 >= 0 and d4 <= d3: b is nearest                             (2)
///   vc = d1 d4 - d3 d2 <= 0, d1 >= 0, d3 <= 0: on ab, at d1 / (d1 - d3)                     (3)
///   d5 = ab.cp, d6 = ac.cp; d6 >= 0 and d5 <= d6: c is nearest                             (4)
///   vb = d5 d2 - d1 d6 <= 0, d2 >= 0, d6 <= 0: on ac, at d2 / (d2 - d6)                     (5)
///   va = d3 d6 - d5 d4 <= 0, d4 >= d3, d5 >= d6: on bc, at (d4 - d3) / (d4 - d3 + d5 - d6)  (6)
///   else inside, at a + (vb ab + vc ac) / (va + vb + vc)                                   (7)
/// @source    [ERI05] section 5.1.5
/// @deviation none
/// @valid     a triangle with an area; without an area, the result is one of its points or sides
/// @accuracy  double precision: relative error of the distance below 1e-6 of the triangle's size
/// @tests     tests/simulation/collision/test_triangle_tree.cpp
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::sim {

/// Nearest feature of a triangle a, b, c: a corner, an edge, or the interior.
enum class Feature : uint32_t
{
    A,
    B,
    C,
    AB,
    BC,
    CA,
    Inside,
};
constexpr size_t kFeatures = 7;

struct NearestPoint
{
    glm::dvec3 point; ///< [m]
    Feature feature;
};

inline NearestPoint nearestOnTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                      const glm::dvec3& c)
{
    const glm::dvec3 ab = b - a, ac = c - a;
    const double d1 = glm::dot(ab, p - a), d2 = glm::dot(ac, p - a);
    if (d1 <= 0.0 && d2 <= 0.0) // (1)
        return {a, Feature::A};
    const double d3 = glm::dot(ab, p - b), d4 = glm::dot(ac, p - b);
    if (d3 >= 0.0 && d4 <= d3) // (2)
        return {b, Feature::B};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3) // (3)
        return {a + d1 / (d1 - d3) * ab, Feature::AB};
    const double d5 = glm::dot(ab, p - c), d6 = glm::dot(ac, p - c);
    if (d6 >= 0.0 && d5 <= d6) // (4)
        return {c, Feature::C};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6) // (5)
        return {a + d2 / (d2 - d6) * ac, Feature::CA};
    const double va = d3 * d6 - d5 * d4;
    const double onC = d4 - d3, onB = d5 - d6;
    if (va <= 0.0 && onC >= 0.0 && onB >= 0.0 && onC + onB > 0.0) // (6)
        return {b + onC / (onC + onB) * (c - b), Feature::BC};
    const double sum = va + vb + vc;
    return {sum > 0.0 ? a + (vb * ab + vc * ac) / sum : a, Feature::Inside}; // (7)
}

} // namespace fx::sim
