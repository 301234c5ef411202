/// @file mesh_surface.h
/// The triangles of a mesh, divided into closed solids and open sheets.
#pragma once

#include "simulation/collision/point_triangle.h"
#include "simulation/collision/triangle_mesh.h"

#include <array>
#include <memory_resource>
#include <vector>

namespace fx::sim {

using Triangle = std::array<glm::vec3, 3>; ///< [m] corners relative to the mesh's origin

/// @formula angle-weighted-pseudonormal
/// Side of a sheet on which a point lies, also if a corner or edge of a triangle is nearest.
///
/// symbol   unit   meaning
///   nk       1      unit normal of triangle k
///   ak       rad    its angle at a corner
///   N        1      pseudonormal, not normalized
///   p, q     m      a point, and the point of the sheet nearest to it
/// @derivation
///   at a corner, over the triangles that meet there       N = sum ak nk     (1)
///   at an edge, over the triangles that share it          N = sum nk        (2)
///   in the interior of a triangle                         N = nk            (3)
///   p is in front of the sheet when (p - q).N >= 0                         (4)
/// @source    [BA05]
/// @deviation the angle in (1) is computed with the C library's arc cosine and rounded to a multiple
///            of 2^-20, so that libraries which differ in the last bits agree
/// @valid     triangles with an area; beyond the border of a sheet the side is that of its border
/// @accuracy  exact but for rounding where the sheet is a manifold
/// @tests     tests/simulation/collision/test_mesh_surface.cpp
///
/// A piece of a mesh is a set of triangles connected by edges; corners at the same position are one corner. A
/// piece is a solid if it is closed and its volume is positive. It is closed if each of its edges is used
/// equally often in both directions. All other pieces are sheets with a front and a back: floors, boxes
/// without a bottom, rooms seen from inside.
struct MeshSurface
{
    explicit MeshSurface(std::pmr::memory_resource* memory) : solids(memory), sheets(memory), normals(memory)
    {}
    std::pmr::vector<Triangle> solids;
    std::pmr::vector<Triangle> sheets;
    /// pseudonormals of each triangle in `sheets`
    std::pmr::vector<std::array<glm::vec3, kFeatures>> normals;
};

/// Divides the triangles of a mesh into solids and sheets. Triangles of zero area are omitted. Throws
/// std::bad_alloc.
MeshSurface sortTriangles(const TriangleMesh& mesh, std::pmr::memory_resource* memory);

} // namespace fx::sim
