/// @file triangle_scene.h
/// Computes the intersection of rays with opaque triangles, and the occlusion by triangles.
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

/// Triangles with a diffuse color per vertex; each triangle has three vertices of its own. The caller owns
/// the arrays.
struct OpaqueMesh
{
    glm::dvec3 origin{0.0};               ///< [m] world position to which the vertices are relative
    std::span<const glm::vec3> positions; ///< [m]
    std::span<const glm::vec3> normals;   ///< unit vectors
    std::span<const glm::vec3> colors;    ///< [0, 1] linear albedo
    /// True: relief and color of the level mesh vary by formula soil-texture. `colors` are the mean.
    bool isSoil = false;
};

/// The first intersection of a ray with a triangle.
struct SurfaceHit
{
    /// [m] ray parameter of the intersection; infinite: there is none
    double distance = std::numeric_limits<double>::infinity();
    uint32_t triangle = 0;
    double u = 0.0, v = 0.0; ///< [1] weights of the second and third vertex

    bool isHit() const { return distance < std::numeric_limits<double>::infinity(); }
};

/// [1] Height above a surface at which rays that leave the surface begin, divided by the distance of the
/// surface from the previous origin.
constexpr double kSurfaceLift = 1e-6;

/// Interpolates an attribute of the vertices at `hit`.
inline glm::dvec3 interpolate(std::span<const glm::vec3> column, const SurfaceHit& hit)
{
    const size_t first = size_t(hit.triangle) * 3;
    return (1.0 - hit.u - hit.v) * glm::dvec3(column[first]) + hit.u * glm::dvec3(column[first + 1]) +
           hit.v * glm::dvec3(column[first + 2]);
}

/// Intersects rays with triangles, by a tree of their bounding balls. Coordinates are relative to the origin
/// passed to build().
class TriangleScene
{
public:
    void build(const OpaqueMesh& mesh, const glm::dvec3& origin, base::TaskRunner& tasks);

    bool empty() const { return tree_.count() == 0; }
    const BallTree& tree() const { return tree_; }

    /// The nearest intersection after the ray parameter `begin` with the triangles whose balls are in `hits`.
    /// Triangles are two-sided.
    SurfaceHit nearest(const TraceRay& ray, const RayHits& hits, double begin) const;
    /// The nearest intersection of a ray with all triangles.
    /// @param scratch memory that is overwritten; reuse it for further calls
    SurfaceHit trace(const TraceRay& ray, double begin, RayHits& scratch) const;

private:
    struct Triangle
    {
        glm::dvec3 corner, edge1, edge2; ///< [m]
        uint32_t index;                  ///< index in the mesh
    };
    void meet(const Triangle& triangle, const TraceRay& ray, double begin, SurfaceHit& io) const;

    BallTree tree_;
    std::vector<Triangle> triangles_; ///< triangles in the order of the mesh, without degenerate triangles
};

} // namespace fx::render
