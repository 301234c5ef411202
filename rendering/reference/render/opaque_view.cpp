#include "rendering/reference/render/opaque_view.h"

#include "rendering/frame/hill_colors.h"
#include "rendering/reference/render/soil_surface.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr double kLevel = 0.999;     ///< [1] least upward part of the normal of soil
constexpr double kSoilHeight = 0.01; ///< [m] largest distance of soil from the height of the origin
constexpr double kInvPi = std::numbers::inv_pi;

} // namespace

glm::dvec3 groundLuminance(const Lighting& lighting)
{
    const double sun = std::max(double(lighting.sunDirection.y), 0.0) * kInvPi;
    return double(lighting.groundAlbedo) *
           (glm::dvec3(lighting.sunIlluminance) * sun + glm::dvec3(lighting.skyLuminance));
}

void OpaqueView::build(const OpaqueScene& scene, const glm::dvec3& eye, base::TaskRunner& tasks,
                       const PixelWidth& pixel)
{
    pixel_ = pixel;
    scene_ = scene;
    eye_ = eye;
    triangles_.build(scene_.mesh, eye, tasks);
}

OpaqueSample OpaqueView::sample(const TraceRay& ray, double x, double y, const RayHits& hits, double begin,
                                RayHits& scratch, const Illuminance& illuminance) const
{
    OpaqueSample sample;
    const SurfaceHit hit = hasMesh() ? triangles_.nearest(ray, hits, begin) : SurfaceHit{};
    sample.distance = hit.distance;
    sample.luminance =
        hit.isHit() ? surfaceAt(ray, hit, scratch, illuminance) : backgroundAt(ray.direction, x, y);
    return sample;
}

glm::dvec3 OpaqueView::imageAt(double x, double y, bool wraps) const
{
    const OpaqueBackground& b = scene_.background;
    const double column = x * b.width - 0.5;
    const double row = y * b.height - 0.5;
    const double column0 = std::floor(column);
    const double row0 = std::floor(row);
    const auto texel = [&](int i, int j) {
        i = wraps ? (i % b.width + b.width) % b.width : std::clamp(i, 0, b.width - 1);
        j = std::clamp(j, 0, b.height - 1);
        return glm::dvec3(b.image[size_t(j) * size_t(b.width) + size_t(i)]);
    };
    const int i = int(column0);
    const int j = int(row0);
    return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), column - column0),
                    glm::mix(texel(i, j + 1), texel(i + 1, j + 1), column - column0), row - row0);
}

/// Distant hills and trees in front of them, both down to the ground.
glm::dvec3 OpaqueView::withHills(const glm::dvec3& sky, const glm::dvec3& d) const
{
    using namespace formula64;
    const HillColors colors = hillColors(scene_.lighting, scene_.background.horizon);
    const double level = std::max(std::hypot(d.x, d.z), 1e-6);
    const double x = d.x / level, z = d.z / level, elevation = d.y / level, p = pixel_.perDepth;
    const glm::dvec3 behind =
        glm::mix(sky, glm::dvec3(colors.far), fxShareBelow(fxFarHills(x, z, p), elevation, p));
    return glm::mix(behind, glm::dvec3(colors.near), fxShareBelow(fxNearTrees(x, z, p), elevation, p));
}

glm::dvec3 OpaqueView::backgroundAt(const glm::dvec3& d, double x, double y) const
{
    const OpaqueBackground& b = scene_.background;
    if (scene_.isEmpty)
        return glm::dvec3(0.0);
    if (b.image.empty()) {
        const glm::dvec3 sky =
            glm::mix(glm::dvec3(b.luminance), glm::dvec3(b.horizon), std::pow(1.0 - std::max(d.y, 0.0), 4.0));
        return b.hasHills ? withHills(sky, d) : sky;
    }
    if (!b.panorama)
        return imageAt(x, y, false);
    return imageAt(std::atan2(d.x, -d.z) * 0.5 * kInvPi + 0.5,
                   0.5 - std::asin(glm::clamp(d.y, -1.0, 1.0)) * kInvPi, true);
}

glm::dvec3 OpaqueView::surfaceAt(const TraceRay& ray, const SurfaceHit& hit, RayHits& scratch,
                                 const Illuminance& illuminance) const
{
    glm::dvec3 n = glm::normalize(interpolate(scene_.mesh.normals, hit));
    const glm::dvec3 point = ray.origin + ray.direction * hit.distance;
    const double lift = kSurfaceLift * hit.distance;
    glm::dvec3 reflectance = interpolate(scene_.mesh.colors, hit) * kInvPi;
    const glm::dvec3 place = point + eye_ - scene_.mesh.origin;
    if (scene_.mesh.isSoil && n.y > kLevel && std::abs(place.y) < kSoilHeight) {
        const SoilSurface soil = soilSeen({place.x, place.z}, ray.direction, pixel_.at(point));
        n = soil.normal(n);
        reflectance *= soil.share;
    }
    if (!illuminance)
        return reflectance * stageLight(point, n, lift, scratch);
    const glm::dvec3 seen = glm::dot(n, ray.direction) > 0.0 ? -n : n;
    return reflectance * illuminance(point + seen * lift, seen);
}

/// [lx] A ball above the horizon lights as a point in its middle.
glm::dvec3 OpaqueView::lampLight(const SceneLight& lamp, const glm::dvec3& point, const glm::dvec3& n,
                                 double lift, RayHits& scratch) const
{
    const glm::dvec3 way = lamp.position - eye_ - point;
    const double distance = glm::length(way);
    const double facing = glm::dot(n, way);
    if (!(distance > 0.0 && facing > 0.0))
        return glm::dvec3(0.0);
    const double cosine = -glm::dot(way, glm::normalize(glm::dvec3(lamp.direction))) / distance;
    const double share = lamp.isSpot() ? spotFalloff(cosine, std::cos(double(lamp.innerAngle)),
                                                     std::cos(double(lamp.outerAngle)))
                                       : 1.0;
    const double open = std::max(0.0, distance - double(lamp.radius));
    if (!(share > 0.0) || blocks({point + n * lift, way / distance}, open, scratch))
        return glm::dvec3(0.0);
    return glm::dvec3(lamp.intensity) * (share * facing / (distance * distance * distance));
}

/// [lx]
glm::dvec3 OpaqueView::stageLight(const glm::dvec3& point, const glm::dvec3& n, double lift,
                                  RayHits& scratch) const
{
    const Lighting& light = scene_.lighting;
    const glm::dvec3 sun(light.sunDirection);
    const glm::dvec3 sunLight(light.sunIlluminance);
    const glm::dvec3 sky(light.skyLuminance);
    glm::dvec3 illuminance(0.0);
    const double cosine = glm::dot(n, sun);
    if (cosine > 0.0 && sunLight != glm::dvec3(0.0)) {
        const TraceRay shadow{point + n * lift, sun};
        if (!triangles_.trace(shadow, 0.0, scratch).isHit())
            illuminance += sunLight * cosine;
    }
    const glm::dvec3 ground = groundLuminance(light);
    illuminance += std::numbers::pi * glm::mix(ground, sky, 0.5 + 0.5 * n.y);
    for (const EffectLight& fire : scene_.lights) {
        const glm::dvec3 toLight = fire.position - eye_ - point;
        const double d2 = glm::dot(toLight, toLight) + double(fire.radius) * double(fire.radius);
        const double facing = glm::dot(n, toLight) / std::sqrt(d2);
        illuminance +=
            glm::dvec3(fire.intensity) * (std::max(facing * 0.8 + 0.2, 0.0) / d2); // a wide light wraps
    }
    for (const SceneLight& lamp : scene_.lamps)
        illuminance += lampLight(lamp, point, n, lift, scratch);
    return illuminance;
}

} // namespace fx::render
