/// @file triangle_mesh.h
/// A non-owning view of triangles.
#pragma once

#include "foundation/result/status.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace fx::sim {

/// maximum number of triangles; each triangle takes about 300 bytes while a field is built
constexpr uint32_t kMaxMeshTriangles = 1u << 22;
/// [m] largest absolute value of a coordinate, relative to the mesh's origin
constexpr float kFarthestVertex = 1e5f;

/// A view of triangles, which are counter-clockwise seen from outside.
struct TriangleMesh
{
    glm::dvec3 origin{0.0};               ///< [m] world position to which the vertices are relative
    std::span<const glm::vec3> positions; ///< [m] relative to `origin`
    /// three indices per triangle; empty: three consecutive positions per triangle
    std::span<const uint32_t> indices;
    uint32_t triangles() const { return uint32_t((indices.empty() ? positions.size() : indices.size()) / 3); }
    uint32_t vertex(size_t corner) const { return indices.empty() ? uint32_t(corner) : indices[corner]; }
};

/// Checks a mesh.
/// @return InvalidArgument for a position out of range or not finite, an index out of range, or an incomplete
///         triangle; TooLarge for more than kMaxMeshTriangles triangles
base::Status checkMesh(const TriangleMesh& mesh);

} // namespace fx::sim
