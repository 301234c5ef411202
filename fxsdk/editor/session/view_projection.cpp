#include "fxsdk/editor/session/view_projection.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::editor {

namespace {

constexpr double kNear = 0.05; // [m] of the picture

} // namespace

ViewProjection::ViewProjection(const OrbitCamera& camera, const glm::dvec2& low, const glm::dvec2& size)
    : eye_(camera.position()), forward_(glm::normalize(camera.target() - camera.position())),
      middle_(low + 0.5 * size),
      focal_(0.5 * size.y / std::tan(0.5 * glm::radians(double(camera.fovYDegrees))))
{
    right_ = glm::normalize(glm::cross(forward_, glm::dvec3(0.0, 1.0, 0.0)));
    up_ = glm::cross(right_, forward_);
}

std::optional<glm::dvec2> ViewProjection::project(const glm::dvec3& position) const
{
    const glm::dvec3 way = position - eye_;
    const double depth = glm::dot(way, forward_);
    if (!(depth >= kNear * 0.999))
        return std::nullopt;
    return middle_ + focal_ / depth * glm::dvec2(glm::dot(way, right_), -glm::dot(way, up_));
}

std::optional<std::pair<glm::dvec2, glm::dvec2>> ViewProjection::project(const glm::dvec3& a,
                                                                         const glm::dvec3& b) const
{
    const double depthA = glm::dot(a - eye_, forward_) - kNear, depthB = glm::dot(b - eye_, forward_) - kNear;
    if (depthA < 0.0 && depthB < 0.0)
        return std::nullopt;
    const auto cut = [&] { return a + (b - a) * (depthA / (depthA - depthB)); };
    const auto low = project(depthA < 0.0 ? cut() : a), high = project(depthB < 0.0 ? cut() : b);
    if (!low || !high)
        return std::nullopt;
    return std::pair(*low, *high);
}

glm::dvec3 ViewProjection::rayThrough(const glm::dvec2& place) const
{
    const glm::dvec2 way = (place - middle_) / focal_;
    return glm::normalize(forward_ + way.x * right_ - way.y * up_);
}

glm::dvec3 ViewProjection::inPlaneOf(const glm::dvec3& position, const glm::dvec2& place) const
{
    const glm::dvec3 ray = rayThrough(place);
    const double depth = std::max(glm::dot(position - eye_, forward_), kNear);
    return eye_ + ray * (depth / glm::dot(ray, forward_));
}

std::optional<double> ViewProjection::alongLine(const glm::dvec3& from, const glm::dvec3& along,
                                                const glm::dvec2& place) const
{
    // The connection of both lines is perpendicular to each: two equations for the two parameters.
    const glm::dvec3 ray = rayThrough(place), way = from - eye_;
    const double aa = glm::dot(along, along), ar = glm::dot(along, ray);
    const double det = aa - ar * ar;
    if (det < 1e-4 * aa)
        return std::nullopt;
    return (ar * glm::dot(way, ray) - glm::dot(way, along)) / det;
}

double ViewProjection::scaleAt(const glm::dvec3& position) const
{
    return focal_ / std::max(glm::dot(position - eye_, forward_), kNear);
}

} // namespace fx::editor
