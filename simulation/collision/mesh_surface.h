/// @file mesh_surface.h
/// The triangles of a mesh, sorted into those that enclose matter and those that do not.
#pragma once

#include "simulation/collision/point_triangle.h"
#include "simulation/collision/triangle_mesh.h"

#include <array>
#include <memory_resource>
#include <vector>

namespace fx::sim {

using Triangle = std::array<glm::vec3, 3>; ///< [m] relative to the mesh's origin

/// @formula angle-weighted-pseudonormal
/// Which side of a sheet a point is on, also where a corner or side of a triangle is nearest.
///
/// symbol   unit   meaning
///   nk       1      unit normal of triangle k
///   ak       rad    its angle at a corner
///   N        1      pseudonormal, not normalized
///   p, q     m      a point, and the point of the sheet nearest to it
/// @derivation
///   of a corner, over the triangles that meet there       N = sum ak nk     (1)
///   of a side, over those that share it                   N = sum nk        (2)
///   inside of a triangle                                  N = nk            (3)
///   p is in front of the sheet when (p - q).N >= 0                         (4)
/// @source    [BA05]
/// @deviation the angle in (1) is computed with the C library's arc cosine and rounded to a multiple
///            of 2^-20, so that libraries which differ in the last bits agree
/// @valid     triangles with an area; beyond the rim of a sheet the side is that of its rim
/// @accuracy  exact but for rounding where the sheet is a manifold
/// @tests     tests/simulation/collision/test_mesh_surface.cpp
///
/// Pieces of a mesh hang together by edges; corners at the same place are one corner. A piece is a solid when
/// at each of its edges as many triangles go one way as the other, which is what closes it, and its volume is
/// positive. All else are sheets, of which one side is the front: floors, boxes without a bottom, rooms seen
/// from inside.
struct MeshSurface
{
    explicit MeshSurface(std::pmr::memory_resource* memory) : solids(memory), sheets(memory), normals(memory)
    {}
    std::pmr::vector<Triangle> solids;
    std::pmr::vector<Triangle> sheets;
    std::pmr::vector<std::array<glm::vec3, kFeatures>> normals; ///< pseudonormals of each triangle of sheets
};

/// Triangles without an area are left out. Throws std::bad_alloc.
MeshSurface sortTriangles(const TriangleMesh& mesh, std::pmr::memory_resource* memory);

} // namespace fx::sim
