/// @file triangle_scene.h
/// Opaque triangles: intersection and occlusion of rays.
#pragma once

#include "rendering/reference/trace/ball_tree.h"
#include "rendering/reference/trace/ray_grid.h"
#include "rendering/reference/trace/ray_hits.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace fx::render {

/// Triangles with a diffuse color per vertex, three vertices each. Owned by the caller.
struct OpaqueMesh
{
    glm::dvec3 origin{0.0};               ///< [m] world position that the vertices are relative to
    std::span<const glm::vec3> positions; ///< [m]
    std::span<const glm::vec3> normals;   ///< unit
    std::span<const glm::vec3> colors;    ///< [0, 1] linear albedo
};

/// Where a ray meets a triangle first.
struct SurfaceHit
{
    double distance = std::numeric_limits<double>::infinity(); ///< [m] ray parameter; infinite: nowhere
    uint32_t triangle = 0;
    double u = 0.0, v = 0.0; ///< [1] weights of the second and third vertex

    bool isHit() const { return distance < std::numeric_limits<double>::infinity(); }
};

/// [1] of the distance from the ray's origin, by which rays that leave a surface begin above it.
constexpr double kSurfaceLift = 1e-6;

/// A column of vertices at the place of `hit`.
inline glm::dvec3 interpolate(std::span<const glm::vec3> column, const SurfaceHit& hit)
{
    const size_t first = size_t(hit.triangle) * 3;
    return (1.0 - hit.u - hit.v) * glm::dvec3(column[first]) + hit.u * glm::dvec3(column[first + 1]) +
           hit.v * glm::dvec3(column[first + 2]);
}

/// Finds triangles by a tree over balls around them. Coordinates are relative to the origin given to build().
class TriangleScene
{
public:
    void build(const OpaqueMesh& mesh, const glm::dvec3& origin, base::TaskRunner& tasks);

    bool empty() const { return tree_.count() == 0; }
    const BallTree& tree() const { return tree_; }

    /// The nearest of the triangles whose balls are in `hits`, behind the parameter `begin`. Both sides
    /// count.
    SurfaceHit nearest(const TraceRay& ray, const RayHits& hits, double begin) const;
    /// The nearest of all. @param scratch keeps memory from call to call
    SurfaceHit trace(const TraceRay& ray, double begin, RayHits& scratch) const;

private:
    struct Triangle
    {
        glm::dvec3 corner, edge1, edge2; ///< [m]
        uint32_t index;                  ///< in the mesh
    };
    void meet(const Triangle& triangle, const TraceRay& ray, double begin, SurfaceHit& io) const;

    BallTree tree_;
    std::vector<Triangle> triangles_; ///< those that are not degenerate, in the order of the mesh
};

} // namespace fx::render
