#include "rendering/reference/render/scene_lights.h"

#include "rendering/reference/integral/quadrature.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAllDirections = -2.0; ///< a cosine below all
constexpr double kWide = 0.1;         ///< sine of a ball's angular radius from which it takes more directions
constexpr double kMinDistance = 1e-9; ///< [m] that rays are taken to pass a point light at

/// Two unit vectors that stand on `axis` and on each other.
std::array<glm::dvec3, 2> across(const glm::dvec3& axis)
{
    const glm::dvec3 other = std::abs(axis.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 first = glm::normalize(glm::cross(other, axis));
    return {first, glm::cross(axis, first)};
}

/// Appends the ray parameters at which a ray crosses the cone around `axis` from `apex`.
void appendConeCrossings(const TraceRay& ray, const glm::dvec3& apex, const glm::dvec3& axis, double cosine,
                         std::vector<double>& out)
{
    // (axis . (p - apex))^2 = cosine^2 |p - apex|^2 at p = origin + t direction
    const glm::dvec3 o = ray.origin - apex;
    const double c2 = cosine * cosine;
    const double od = glm::dot(o, axis), dd = glm::dot(ray.direction, axis);
    const double a = dd * dd - c2;
    const double b = od * dd - c2 * glm::dot(o, ray.direction);
    const double c = od * od - c2 * glm::dot(o, o);
    const double root = b * b - a * c;
    if (!(root >= 0.0) || a == 0.0)
        return;
    for (const double sign : {-1.0, 1.0})
        out.push_back((-b + sign * std::sqrt(root)) / a);
}

} // namespace

void appendCone(const glm::dvec3& axis, double height, int rings, int sectors, double turn,
                std::vector<ArrivingLight>& out)
{
    const auto [first, second] = across(axis);
    const double half = 0.5 * height;
    for (int i = 0; i < rings; ++i) {
        const auto [node, weight] = integral::gaussNode<double>(uint32_t(rings), uint32_t(i));
        const double below = half * (1.0 - node); // 1 - c, without cancellation for narrow cones
        const double sine = std::sqrt(below * (2.0 - below));
        for (int j = 0; j < sectors; ++j) {
            const double angle = 2.0 * kPi * (j + turn) / sectors; // (1)
            ArrivingLight light;
            light.direction =
                (1.0 - below) * axis + sine * (std::cos(angle) * first + std::sin(angle) * second);
            light.solidAngle = half * weight * 2.0 * kPi / sectors; // (2)
            out.push_back(light);
        }
    }
}

void SceneLights::build(const OpaqueScene& scene, const glm::dvec3& eye, int skyRings)
{
    sun_ = {};
    sun_.direction = glm::dvec3(scene.lighting.sunDirection);
    sun_.illuminance = glm::dvec3(scene.lighting.sunIlluminance);
    sky_ = glm::dvec3(scene.lighting.skyLuminance);
    ground_ = groundLuminance(scene.lighting);
    skyRings_ = skyRings;
    lamps_.clear();
    for (const SceneLight& light : scene.lamps)
        lamps_.push_back({light.position - eye, glm::dvec3(light.intensity), double(light.radius), false,
                          glm::normalize(glm::dvec3(light.direction)),
                          light.isSpot() ? std::cos(double(light.innerAngle)) : kAllDirections,
                          light.isSpot() ? std::cos(double(light.outerAngle)) : kAllDirections});
    for (const EffectLight& fire : scene.lights) {
        lamps_.push_back({fire.position - eye, glm::dvec3(fire.intensity), double(fire.radius), true,
                          glm::dvec3(0.0, 1.0, 0.0), kAllDirections, kAllDirections});
        lamps_.back().ownReach = double(fire.ownReach);
    }
}

void SceneLights::appendLamp(size_t index, const glm::dvec3& point, double turn,
                             std::vector<ArrivingLight>& out) const
{
    const Lamp& lamp = lamps_[index];
    if (!lamp.isGroup && lamp.radius > 0.0)
        return appendBall(lamp, point, turn, out);
    const glm::dvec3 way = lamp.position - point;
    const double distance2 = glm::dot(way, way);
    if (!(distance2 > 0.0))
        return;
    ArrivingLight light;
    const double distance = std::sqrt(distance2);
    light.direction = way / distance;
    light.distance = std::max(0.0, distance - std::max(lamp.radius, lamp.ownReach));
    const double share = spotFalloff(-glm::dot(light.direction, lamp.axis), lamp.inner, lamp.outer);
    light.illuminance = lamp.intensity * (share / (distance2 + lamp.radius * lamp.radius));
    if (share > 0.0)
        out.push_back(light);
}

void SceneLights::appendBall(const Lamp& lamp, const glm::dvec3& point, double turn,
                             std::vector<ArrivingLight>& out) const
{
    const double radius2 = lamp.radius * lamp.radius;
    const glm::dvec3 luminance = lamp.intensity / (kPi * radius2);
    const glm::dvec3 way = lamp.position - point;
    const double distance2 = glm::dot(way, way);
    const size_t first = out.size();
    const bool isInside = distance2 <= radius2;
    if (isInside) {
        for (const double side : {1.0, -1.0})
            appendCone({0.0, side, 0.0}, 1.0, 4, 16, turn, out);
    } else {
        const double sine2 = radius2 / distance2;
        const bool isWide = sine2 > kWide * kWide;
        const double height = sine2 / (1.0 + std::sqrt(1.0 - sine2)); // 1 - cosine, without cancellation
        appendCone(way / std::sqrt(distance2), height, isWide ? 4 : 2, isWide ? 8 : 4, turn, out);
    }
    for (size_t i = first; i < out.size(); ++i) {
        const double along = glm::dot(way, out[i].direction);
        const double toShell = std::sqrt(std::max(0.0, along * along - (distance2 - radius2)));
        out[i].distance = isInside ? along + toShell : along - toShell;
        out[i].illuminance = luminance * out[i].solidAngle;
    }
}

void SceneLights::course(size_t index, const TraceRay& ray, Course& out) const
{
    const Lamp& lamp = lamps_[index];
    const glm::dvec3 way = lamp.position - ray.origin;
    out.nearest = glm::dot(way, ray.direction);
    const glm::dvec3 aside = way - out.nearest * ray.direction;
    const double passing2 = glm::dot(aside, aside);
    const double extent2 = lamp.radius * lamp.radius;
    out.distance = std::sqrt(std::max(passing2, std::max(extent2, kMinDistance * kMinDistance)));
    out.cuts = {out.nearest};
    if (!lamp.isGroup && extent2 > passing2)
        for (const double sign : {-1.0, 1.0})
            out.cuts.push_back(out.nearest + sign * std::sqrt(extent2 - passing2));
    if (lamp.outer > kAllDirections)
        for (const double cosine : {lamp.inner, lamp.outer})
            appendConeCrossings(ray, lamp.position, lamp.axis, cosine, out.cuts);
    std::sort(out.cuts.begin(), out.cuts.end());
}

void SceneLights::appendSky(const glm::dvec2& shift, int density, std::vector<ArrivingLight>& out) const
{
    const int rings = density * skyRings_, sectors = 2 * rings;
    for (const double side : {1.0, -1.0})
        for (int ring = 0; ring < rings; ++ring) {
            const double height = (ring + shift.y) / rings; // (1)
            const double across = std::sqrt(1.0 - height * height);
            for (int j = 0; j < sectors; ++j) {
                const double angle = 2.0 * kPi * (j + shift.x) / sectors;
                ArrivingLight light;
                light.direction = {across * std::cos(angle), side * height, across * std::sin(angle)};
                light.solidAngle = 2.0 * kPi / (rings * sectors);
                light.illuminance = (side > 0.0 ? sky_ : ground_) * light.solidAngle;
                out.push_back(light);
            }
        }
}

} // namespace fx::render
