#include "rendering/reference/render/triangle_scene.h"

#include "rendering/reference/trace/ray_query.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {
constexpr double kRim = 1.0 + 1e-9; ///< by which balls are larger than their triangle: a corner lies inside
}

void TriangleScene::build(const OpaqueMesh& mesh, const glm::dvec3& origin, base::TaskRunner& tasks)
{
    const glm::dvec3 offset = mesh.origin - origin;
    triangles_.clear();
    std::vector<TraceBall> balls;
    for (size_t i = 0; i + 2 < mesh.positions.size(); i += 3) {
        const glm::dvec3 a = offset + glm::dvec3(mesh.positions[i]);
        const glm::dvec3 b = offset + glm::dvec3(mesh.positions[i + 1]);
        const glm::dvec3 c = offset + glm::dvec3(mesh.positions[i + 2]);
        const double area = glm::length(glm::cross(b - a, c - a));
        if (!(area > 0.0 && area < std::numeric_limits<double>::infinity()))
            continue;
        const glm::dvec3 middle = 0.5 * (glm::min(glm::min(a, b), c) + glm::max(glm::max(a, b), c));
        const double radius =
            std::max({glm::length(a - middle), glm::length(b - middle), glm::length(c - middle)});
        balls.push_back({middle, radius * kRim});
        triangles_.push_back({a, b - a, c - a, uint32_t(i / 3)});
    }
    tree_.build(balls, glm::dvec3(0.0), tasks);
}

void TriangleScene::meet(const Triangle& triangle, const TraceRay& ray, double begin, SurfaceHit& io) const
{
    // Cramer's rule for corner + u edge1 + v edge2 = origin + t direction.
    const glm::dvec3 p = glm::cross(ray.direction, triangle.edge2);
    const double determinant = glm::dot(triangle.edge1, p);
    if (determinant == 0.0)
        return;
    const glm::dvec3 toOrigin = ray.origin - triangle.corner;
    const double u = glm::dot(toOrigin, p) / determinant;
    const glm::dvec3 q = glm::cross(toOrigin, triangle.edge1);
    const double v = glm::dot(ray.direction, q) / determinant;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0))
        return;
    const double t = glm::dot(triangle.edge2, q) / determinant;
    if (t > begin && (t < io.distance || (t == io.distance && triangle.index < io.triangle)))
        io = {t, triangle.index, u, v};
}

SurfaceHit TriangleScene::nearest(const TraceRay& ray, const RayHits& hits, double begin) const
{
    SurfaceHit hit;
    for (size_t i = 0; i < hits.size(); ++i)
        if (hits.enter[i] <= hit.distance)
            meet(triangles_[tree_.ballAt(hits.place[i])], ray, begin, hit);
    return hit;
}

SurfaceHit TriangleScene::trace(const TraceRay& ray, double begin, RayHits& scratch) const
{
    findHits(tree_, ray, begin, std::numeric_limits<double>::infinity(), scratch);
    return nearest(ray, scratch, begin);
}

} // namespace fx::render
