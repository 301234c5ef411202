#include "rendering/reference/render/blob_light.h"

#include "rendering/optics/phase.h"
#include "rendering/reference/render/shadow_ray.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fx::render {

namespace {

constexpr double kFar = 1e30; ///< [m] to the sun and the sky

struct Direction
{
    glm::dvec3 to;
    double weight;
};

/// (2)
std::vector<Direction> sphere()
{
    std::vector<Direction> directions;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 to(0.0);
            to[axis] = side;
            directions.push_back({to, 1.0 / 15.0});
        }
    const double c = 1.0 / std::numbers::sqrt3;
    for (int corner = 0; corner < 8; ++corner)
        directions.push_back({{corner & 1 ? c : -c, corner & 2 ? c : -c, corner & 4 ? c : -c}, 3.0 / 40.0});
    return directions;
}

/// Light at one point after the other.
class CenterLight
{
public:
    CenterLight(const MediumView& medium, const OpaqueView& opaque, const SceneLights& lights)
        : shadow_(medium, opaque), lights_(lights), directions_(sphere())
    {}

    /// [cd/m2] mean over all directions
    glm::dvec3 ambient(const glm::dvec3& point)
    {
        glm::dvec3 sum(0.0);
        for (const Direction& direction : directions_) {
            const TraceRay ray{point, direction.to};
            const double end = std::min(shadow_.toSurface(ray), kFar);
            const double share = end < kFar ? 0.0 : std::clamp(0.5 + direction.to.y, 0.0, 1.0); // (3)
            sum += glm::mix(lights_.ground(), lights_.sky(), share) *
                   (direction.weight * shadow_.transmittance(ray, end));
        }
        return sum;
    }

    /// [cd/m2] from sun, lamps and glowing groups, of one whose phase function has the anisotropy `g`
    glm::dvec3 direct(const glm::dvec3& point, float g)
    {
        const glm::dvec3 look = glm::normalize(point + glm::dvec3(1e-30));
        arriving_.clear();
        if (lights_.hasSun())
            arriving_.push_back(lights_.sun());
        for (size_t lamp = 0; lamp < lights_.lampCount(); ++lamp)
            lights_.appendLamp(lamp, point, 0.5, arriving_);
        glm::dvec3 sum(0.0);
        for (const ArrivingLight& light : arriving_) {
            const double cosine = glm::dot(look, light.direction);
            sum += light.illuminance * (double(henyeyGreenstein(float(cosine), g)) *
                                        shadow_.visibility({point, light.direction}, light.distance));
        }
        return sum;
    }

private:
    ShadowRay shadow_;
    const SceneLights& lights_;
    std::vector<Direction> directions_;
    std::vector<ArrivingLight> arriving_;
};

} // namespace

std::vector<glm::vec3> lightAtCenters(const MediumView& medium, const OpaqueView& opaque,
                                      const SceneLights& lights, base::TaskRunner& tasks)
{
    std::vector<glm::vec3> light;
    if (!lights.hasSun() && !lights.hasSky() && lights.lampCount() == 0)
        return light;
    light.resize(medium.tree().count());
    tasks.parallelFor(medium.tree().count(), 64, [&](uint32_t begin, uint32_t end) {
        CenterLight at(medium, opaque, lights);
        for (uint32_t place = begin; place < end; ++place) {
            const auto& c = medium.blob(place).center;
            const MediumView::Scattering& s = medium.scattering(place);
            const glm::dvec3 center(c[0], c[1], c[2]);
            if (s.albedo == glm::vec3(0.0f))
                continue;
            light[place] = s.albedo * glm::vec3(at.ambient(center) + at.direct(center, s.anisotropy)); // (1)
        }
    });
    return light;
}

} // namespace fx::render
