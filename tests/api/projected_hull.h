/// @file projected_hull.h
/// The visible part of a convex body, in front of the near plane, as a convex polygon in the picture.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace fx::test {

class ProjectedHull
{
public:
    /// Projects a convex body and clips it at the near plane.
    /// @param corners    [m] points in eye coordinates, whose convex hull is the body
    /// @param projection matrix from eye to clip space
    /// @param nearPlane  [m] distance of the near plane
    ProjectedHull(const std::vector<glm::dvec3>& corners, const glm::dmat4& projection, double nearPlane,
                  glm::dvec2 size)
    {
        std::vector<glm::dvec2> points;
        const auto add = [&](const glm::dvec3& p) {
            const glm::dvec4 clip = projection * glm::dvec4(p, 1.0);
            points.push_back((0.5 * glm::dvec2(clip) / clip.w + 0.5) * size);
        };
        for (const glm::dvec3& a : corners) {
            if (-a.z < nearPlane)
                continue;
            add(a);
            for (const glm::dvec3& b : corners) // among these are all edges
                if (-b.z < nearPlane)
                    add(glm::mix(a, b, (-nearPlane - a.z) / (b.z - a.z)));
        }
        wrap(points);
    }

    bool empty() const { return polygon_.empty(); }
    /// [pixel] Corners of the bounding rectangle; the polygon must not be empty.
    glm::dvec2 low() const { return extreme(-1.0); }
    glm::dvec2 high() const { return extreme(1.0); }
    /// [pixel] Distance of a point from the polygon; 0 inside, infinite if the polygon is empty.
    double distance(glm::dvec2 point) const
    {
        double nearest = std::numeric_limits<double>::infinity();
        bool isInside = polygon_.size() > 2;
        for (size_t i = 0; i < polygon_.size(); ++i) {
            const glm::dvec2 a = polygon_[i], edge = polygon_[(i + 1) % polygon_.size()] - a;
            const glm::dvec2 to = point - a;
            isInside = isInside && edge.x * to.y - edge.y * to.x >= 0.0;
            const double length2 = glm::dot(edge, edge);
            const double t = length2 > 0.0 ? std::clamp(glm::dot(to, edge) / length2, 0.0, 1.0) : 0.0;
            nearest = std::min(nearest, glm::length(to - t * edge));
        }
        return isInside ? 0.0 : nearest;
    }

private:
    glm::dvec2 extreme(double sign) const
    {
        glm::dvec2 most = sign * polygon_[0];
        for (const glm::dvec2& p : polygon_)
            most = glm::max(most, sign * p);
        return sign * most;
    }
    /// Computes the convex hull by Andrew's monotone chain, counterclockwise.
    void wrap(std::vector<glm::dvec2>& points)
    {
        std::sort(points.begin(), points.end(),
                  [](auto a, auto b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
        const auto half = [this](auto begin, auto end) {
            const size_t start = polygon_.size();
            for (auto p = begin; p != end; ++p) {
                while (polygon_.size() >= start + 2 && !turnsLeft(*p))
                    polygon_.pop_back();
                polygon_.push_back(*p);
            }
            if (!polygon_.empty())
                polygon_.pop_back(); // the other half begins with it
        };
        if (points.size() == 1)
            polygon_ = points;
        else {
            half(points.begin(), points.end());
            half(points.rbegin(), points.rend());
        }
    }
    bool turnsLeft(glm::dvec2 p) const
    {
        const glm::dvec2 a = polygon_[polygon_.size() - 2], b = polygon_.back();
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0.0;
    }

    std::vector<glm::dvec2> polygon_;
};

} // namespace fx::test
