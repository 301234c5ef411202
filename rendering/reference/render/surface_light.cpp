#include "rendering/reference/render/surface_light.h"

#include <glm/geometric.hpp>

#include <numbers>

namespace fx::render {

namespace {
constexpr double kTurn = 0.5; ///< of directions about the vertical
constexpr int kDensity = 2;   ///< of directions of the sky: no mean is taken along a ray
} // namespace

glm::dvec3 SurfaceLight::at(const glm::dvec3& position, const glm::dvec3& normal)
{
    arriving_.clear();
    if (lights_.hasSun())
        arriving_.push_back(lights_.sun());
    for (size_t lamp = 0; lamp < lights_.lampCount(); ++lamp)
        lights_.appendLamp(lamp, position, kTurn, arriving_);
    glm::dvec3 sum(0.0);
    for (const ArrivingLight& light : arriving_) {
        const double cosine = glm::dot(normal, light.direction);
        if (cosine > 0.0)
            sum += light.illuminance *
                   (cosine * shadow_.visibility({position, light.direction}, light.distance));
    }
    return lights_.hasSky() ? sum + skyAt(position, normal) : sum; // (1)
}

glm::dvec3 SurfaceLight::skyAt(const glm::dvec3& position, const glm::dvec3& normal)
{
    arriving_.clear();
    lights_.appendSky(glm::dvec2(kTurn), kDensity, arriving_);
    double seen[2] = {}, all[2] = {}; // above, below
    for (const ArrivingLight& light : arriving_) {
        const double weight = light.solidAngle * glm::dot(normal, light.direction);
        const bool isBelow = light.direction.y < 0.0;
        if (!(weight > 0.0))
            continue;
        all[isBelow] += weight;
        if (light.illuminance != glm::dvec3(0.0))
            seen[isBelow] += weight * shadow_.visibility({position, light.direction}, light.distance);
    }
    glm::dvec3 sum(0.0);
    if (all[0] > 0.0)
        sum += lights_.sky() * ((0.5 + 0.5 * normal.y) * seen[0] / all[0]); // (2)
    if (all[1] > 0.0)
        sum += lights_.ground() * ((0.5 - 0.5 * normal.y) * seen[1] / all[1]);
    return sum * std::numbers::pi;
}

} // namespace fx::render
