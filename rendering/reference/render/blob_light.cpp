#include "rendering/reference/render/blob_light.h"

#include "rendering/optics/phase.h"
#include "rendering/reference/render/chord_depth.h"
#include "rendering/reference/trace/ray_query.h"

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
    CenterLight(const MediumView& medium, const OpaqueView& opaque)
        : medium_(medium), opaque_(opaque), directions_(sphere())
    {
        const Lighting& light = opaque.scene().lighting;
        sun_ = glm::dvec3(light.sunDirection);
        sky_ = glm::dvec3(light.skyLuminance);
        ground_ = groundLuminance(light);
    }

    /// [cd/m2] mean over all directions
    glm::dvec3 ambient(const glm::dvec3& point)
    {
        glm::dvec3 sum(0.0);
        for (const Direction& direction : directions_) {
            const TraceRay ray{point, direction.to};
            const double end = std::min(opaque_.distance(ray, scratch_), kFar);
            const double share = end < kFar ? 0.0 : std::clamp(0.5 + direction.to.y, 0.0, 1.0); // (3)
            sum += glm::mix(ground_, sky_, share) * (direction.weight * transmittance(ray, end));
        }
        return sum;
    }

    /// [cd/m2] from the sun and glowing groups, of one whose phase function has the anisotropy `g`
    glm::dvec3 direct(const glm::dvec3& point, float g)
    {
        const glm::dvec3 look = glm::normalize(point + glm::dvec3(1e-30));
        const auto lit = [&](const glm::dvec3& to, double distance) {
            const TraceRay ray{point, to};
            if (opaque_.distance(ray, scratch_) < distance)
                return 0.0;
            return double(henyeyGreenstein(float(glm::dot(look, to)), g)) * transmittance(ray, distance);
        };
        const glm::dvec3 sunLight(opaque_.scene().lighting.sunIlluminance);
        glm::dvec3 sum(0.0);
        if (sunLight != glm::dvec3(0.0))
            sum += sunLight * lit(sun_, kFar);
        for (const EffectLight& fire : opaque_.scene().lights) {
            const glm::dvec3 way = fire.position - opaque_.eye() - point;
            const double distance = glm::length(way);
            const double radius = double(fire.radius);
            if (distance > 0.0)
                sum += glm::dvec3(fire.intensity) * (lit(way / distance, std::max(distance - radius, 0.0)) /
                                                     (distance * distance + radius * radius));
        }
        return sum;
    }

private:
    double transmittance(const TraceRay& ray, double end)
    {
        findHits(medium_.tree(), ray, 0.0, end, hits_);
        return std::exp(-opticalDepthOf(medium_, hits_, 0.0, end));
    }

    const MediumView& medium_;
    const OpaqueView& opaque_;
    std::vector<Direction> directions_;
    glm::dvec3 sun_, sky_, ground_;
    RayHits hits_, scratch_;
};

bool shines(const OpaqueScene& scene, bool lights)
{
    const glm::vec3 none(0.0f);
    const Lighting& light = scene.lighting;
    return light.skyLuminance != none || light.sunIlluminance != none || (lights && !scene.lights.empty());
}

} // namespace

std::vector<glm::vec3> lightAtCenters(const MediumView& medium, const OpaqueView& opaque, bool lights,
                                      base::TaskRunner& tasks)
{
    std::vector<glm::vec3> light;
    if (!shines(opaque.scene(), lights))
        return light;
    light.resize(medium.tree().count());
    tasks.parallelFor(medium.tree().count(), 64, [&](uint32_t begin, uint32_t end) {
        CenterLight at(medium, opaque);
        for (uint32_t place = begin; place < end; ++place) {
            const auto& c = medium.blob(place).center;
            const MediumView::Scattering& s = medium.scattering(place);
            const glm::dvec3 center(c[0], c[1], c[2]);
            if (s.albedo == glm::vec3(0.0f))
                continue;
            glm::dvec3 sum = at.ambient(center);
            if (lights)
                sum += at.direct(center, s.anisotropy);
            light[place] = s.albedo * glm::vec3(sum); // (1)
        }
    });
    return light;
}

} // namespace fx::render
