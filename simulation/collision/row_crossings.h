/// @file row_crossings.h
/// Crossings of triangles with the lines of a grid.
///
/// @formula row-winding-number
/// Winding number of closed surfaces around each node of a row, from their crossings with the row.
///
/// symbol   unit   meaning
///   p        m      a node; its row is the line through it along x
///   y, z     m      coordinates of the row
///   xk       m      position at which triangle k crosses the row
///   sk       1      +1 when triangle k faces towards +x, -1 when towards -x
///   w        1      winding number
/// @derivation
///   The winding number of a closed surface is the solid angle seen from p over 4 pi. It is an integer and
///   equals the signed number of crossings of any ray from p to infinity. Along +x
///       w(p) = sum of sk over xk > p.x                                                           (1)
///   Triangle k crosses the row if the row's (y, z) is on the same side of its three projected edges,
///       E(u, v) = (v.y - u.y)(z - u.z) - (v.z - u.z)(y - u.y)                                     (2)
///   evaluated from the smaller to the larger end of each edge, so that adjacent triangles agree bit for bit.
///   A row through an edge or corner is moved by (e, e^2), e -> 0: if E is 0, its sign is that of -(v.z -
///   u.z), and if that is 0 as well, the sign of v.y - u.y
///   (3) A node is inside of matter if w > 0, also if several solids overlap                          (4)
/// @source    [JKS13] section 3 for the winding number; (3) is the simulation of simplicity of [EM90]
/// @deviation crossings are counted on a row of nodes at once instead of adding solid angles, which is
///            equal for closed surfaces
/// @valid     closed surfaces: each edge is used equally often in both directions
/// @accuracy  exact, except for nodes whose distance to the surface is below the rounding of xk
/// @tests     tests/simulation/collision/test_distance_field.cpp
#pragma once

#include "simulation/collision/distance_grid.h"
#include "simulation/collision/mesh_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace fx::sim {

/// Side of the edge from u to v on which the row at (y, z) passes. The result is +1 or -1, or 0 if u and v
/// are the same point.
inline int sideOf(const glm::dvec3& u, const glm::dvec3& v, double y, double z)
{
    const bool isTurned = std::tie(v.x, v.y, v.z) < std::tie(u.x, u.y, u.z);
    const glm::dvec3& from = isTurned ? v : u;
    const glm::dvec3& to = isTurned ? u : v;
    const double dy = to.y - from.y, dz = to.z - from.z;
    double side = dy * (z - from.z) - dz * (y - from.y); // (2)
    if (side == 0.0)
        side = dz != 0.0 ? -dz : dy; // (3)
    const int sign = side > 0.0 ? 1 : (side < 0.0 ? -1 : 0);
    return isTurned ? -sign : sign;
}

/// Calls f(y, z, x, sign) for each row of the grid along `axis` that the triangle crosses. y and z are the
/// row's indices along the next two axes; x [m] is the position of the crossing along the row.
template <class F>
void forEachCrossing(const Triangle& triangle, const DistanceGrid& grid, int axis, F&& f)
{
    const std::array<int, 3> axes{axis, (axis + 1) % 3,
                                  (axis + 2) % 3}; // turned so that the row runs along x
    const auto turned = [&](const glm::vec3& p) { return glm::dvec3(p[axes[0]], p[axes[1]], p[axes[2]]); };
    const glm::dvec3 a = turned(triangle[0]), b = turned(triangle[1]), c = turned(triangle[2]);
    const auto node = [&](double place, int k) {
        return (place - double(grid.low[axes[size_t(k)]])) / double(grid.cell);
    };
    const auto place = [&](uint32_t i, int k) {
        return double(grid.low[axes[size_t(k)]]) + double(grid.cell) * i;
    };
    const auto firstOf = [&](int k) {
        return uint32_t(std::max(std::floor(node(std::min({a[k], b[k], c[k]}), k)), 0.0));
    };
    const auto lastOf = [&](int k) {
        const double last = std::ceil(node(std::max({a[k], b[k], c[k]}), k));
        return uint32_t(std::clamp(last, 0.0, double(grid.nodes[axes[size_t(k)]] - 1)));
    };
    const double ny = (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z);
    const double nz = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const double nx = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
    for (uint32_t row = firstOf(2); row <= lastOf(2); ++row)
        for (uint32_t column = firstOf(1); column <= lastOf(1); ++column) {
            const glm::dvec3 at(0.0, place(column, 1), place(row, 2));
            const int side = sideOf(a, b, at.y, at.z);
            if (side == 0 || sideOf(b, c, at.y, at.z) != side || sideOf(c, a, at.y, at.z) != side)
                continue;
            const double shift = nx != 0.0 ? (ny * (at.y - a.y) + nz * (at.z - a.z)) / nx : 0.0;
            f(column, row, a.x - shift, side);
        }
}

} // namespace fx::sim
