#include "rendering/reference/path/path_integrator.h"

#include "rendering/reference/path/path_equiangular.h"
#include "rendering/reference/render/soil_surface.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace fx::render {

namespace {

constexpr double kInvPi = std::numbers::inv_pi;
constexpr double kFar = std::numeric_limits<double>::infinity();

double largest(const glm::dvec3& v)
{
    return std::max({v.x, v.y, v.z});
}

double sum(const glm::dvec3& v)
{
    return v.x + v.y + v.z;
}

constexpr uint32_t kSeenEmission = 2; ///< places by each method on the way of the eye's ray

} // namespace

PathIntegrator::PathIntegrator(const PathScene& scene, const PathSettings& settings)
    : scene_(scene), settings_(settings), tracker_(scene.medium, settings.flight, settings.shadow)
{}

SurfaceHit PathIntegrator::surface(const TraceRay& ray, double begin)
{
    if (!scene_.triangles || scene_.triangles->empty())
        return {};
    return scene_.triangles->trace(ray, begin, hits_);
}

glm::dvec3 PathIntegrator::arriving(const LightSample& sample, const glm::dvec3& position,
                                    PathSampler& sampler)
{
    const TraceRay shadow{position, sample.direction};
    if (surface(shadow, 0.0).distance < sample.distance)
        return glm::dvec3(0.0);
    return sample.illuminance * tracker_.transmittance(shadow, 0.0, sample.distance, sampler);
}

glm::dvec3 PathIntegrator::lightAt(const Way& way, PathSampler& sampler)
{
    const TraceRay& ray = way.start.ray;
    const glm::dvec3 position = ray.origin + ray.direction * way.flight.distance;
    glm::dvec3 light(0.0);
    for (const PathLight* source : scene_.lights) {
        const LightSample sample = source->sample(position, sampler.pair());
        double share = way.flight.phase.at(glm::dot(ray.direction, sample.direction));
        if (!(largest(sample.illuminance) * share > 0.0))
            continue;
        const std::optional<LightPlace> place = source->place();
        if (place && tracker_.lastWay()) {
            const Equiangular others(ray, tracker_.lastWay()->extent(), *place);
            const double density = collisionDensity(way, way.flight.distance);
            if (others.isNear())
                share *= density / (density + others.density(way.flight.distance));
        }
        light += share * arriving(sample, position, sampler);
    }
    return light;
}

double PathIntegrator::collisionDensity(const Way& way, double parameter) const
{
    const DepthWalk& medium = *tracker_.lastWay();
    const double colliding = way.start.isForced ? -std::expm1(-medium.depth()) : 1.0;
    return medium.at(parameter, 0.0).extinction.x * std::exp(-medium.depthTo(parameter)) / colliding;
}

glm::dvec3 PathIntegrator::lightOnWay(const Way& way, PathSampler& sampler)
{
    glm::dvec3 light(0.0);
    if (!tracker_.lastWay() || !(tracker_.lastWay()->depth() > 0.0))
        return light;
    const TraceRay& ray = way.start.ray;
    const DepthWalk& medium = *tracker_.lastWay();
    for (const PathLight* source : scene_.lights) {
        const std::optional<LightPlace> place = source->place();
        if (!place)
            continue;
        const Equiangular places(ray, medium.extent(), *place);
        if (!places.isNear())
            continue;
        const auto [u, choice] = sampler.pair();
        const double t = places.parameter(u);
        const glm::dvec3 position = ray.origin + ray.direction * t;
        const LightSample sample = source->sample(position, sampler.pair());
        const MediumPoint point = medium.at(t, choice);
        const double passing = std::exp(-medium.depthTo(t));
        const double densities = collisionDensity(way, t) + places.density(t);
        const double share = point.phase.at(glm::dot(ray.direction, sample.direction)) * passing / densities;
        if (largest(sample.illuminance) * largest(point.scattering) * share > 0.0)
            light += share * point.scattering * arriving(sample, position, sampler);
    }
    return light;
}

template <class Density>
glm::dvec3 PathIntegrator::emissionAt(const glm::dvec3& position, const Density& density,
                                      PathSampler& sampler)
{
    const double chance = tracker_.lastWay() ? scene_.medium->emissionChance(position) : 0.0;
    if (!(chance > 0.0) || (chance < 1.0 && sampler.number() >= chance))
        return glm::dvec3(0.0); // both densities below contain the chance
    const auto [u, v] = sampler.pair();
    const glm::dvec3 direction = scene_.medium->emissionDirection(position, {sampler.number(), u, v});
    const double share = density(direction);
    if (!(share > 0.0))
        return glm::dvec3(0.0);
    const TraceRay ray{position, direction};
    return share * tracker_.emissionFrom(ray, surface(ray, 0.0).distance, share, sampler);
}

glm::dvec3 PathIntegrator::scatter(const Way& way, PathSampler& sampler, FlightStart& outNext)
{
    const TraceRay& ray = way.start.ray;
    const PhaseFunction& phase = way.flight.phase;
    const glm::dvec3 position = ray.origin + ray.direction * way.flight.distance;
    glm::dvec3 light = lightAt(way, sampler);
    light += emissionAt(
        position, [&](const glm::dvec3& to) { return phase.at(glm::dot(ray.direction, to)); }, sampler);
    const auto [u, turn] = sampler.pair();
    const double cosine = phase.cosine(u);
    outNext.ray = {position, PhaseFunction::around(ray.direction, cosine, turn)};
    outNext.density = phase.at(cosine);
    return light;
}

PathIntegrator::SurfacePoint PathIntegrator::surfaceAt(const SurfaceHit& hit, const TraceRay& ray,
                                                       bool isSeen) const
{
    SurfacePoint point{hit.distance, glm::normalize(interpolate(scene_.mesh.normals, hit)),
                       interpolate(scene_.mesh.colors, hit)};
    if (scene_.mesh.isSoil && isSeen) {
        const glm::dvec3 at = ray.origin + ray.direction * hit.distance;
        const glm::dvec3 place = at + scene_.eye - scene_.mesh.origin;
        const SoilSurface soil = soilSeen({place.x, place.z}, ray.direction, scene_.pixel.at(at));
        point.normal = soil.normal(point.normal);
        point.albedo *= soil.share;
    }
    if (glm::dot(point.normal, ray.direction) > 0.0)
        point.normal = -point.normal;
    return point;
}

void PathIntegrator::reflect(const SurfacePoint& at, const TraceRay& ray, PathSampler& sampler,
                             FlightStart& outNext, glm::dvec3& io, glm::dvec3& outLuminance)
{
    const glm::dvec3& normal = at.normal;
    const glm::dvec3 position =
        ray.origin + ray.direction * at.distance + normal * (kSurfaceLift * at.distance);
    io *= at.albedo;
    for (const PathLight* source : scene_.lights) {
        const LightSample sample = source->sample(position, sampler.pair());
        const double cosine = glm::dot(normal, sample.direction);
        if (largest(sample.illuminance) * cosine > 0.0)
            outLuminance += io * (cosine * kInvPi) * arriving(sample, position, sampler);
    }
    const auto density = [&](const glm::dvec3& direction) { return glm::dot(normal, direction) * kInvPi; };
    outLuminance += io * emissionAt(position, density, sampler);
    const auto [u, turn] = sampler.pair();
    outNext.ray = {position, PhaseFunction::around(normal, std::sqrt(1.0 - u), turn)};
    outNext.density = std::max(density(outNext.ray.direction), 0.0);
}

PathResult PathIntegrator::trace(const TraceRay& camera, double begin, PathSampler& sampler)
{
    PathResult result;
    Way way;
    way.start = {camera, begin};
    way.start.seenEmission = kSeenEmission;
    glm::dvec3 throughput(1.0);
    double least = settings_.roulette;
    for (uint32_t bounce = 0;; ++bounce) {
        const SurfaceHit hit = surface(way.start.ray, way.start.begin);
        way.start.end = hit.distance;
        way.start.isForced = bounce < settings_.forcedFlights && !hit.isHit();
        const glm::dvec3 before = throughput;
        way.flight = tracker_.fly(way.start, sampler, throughput, result.luminance);
        if (bounce == 0)
            result.opacity = hit.isHit() ? 1.0 : opacity(way, sampler);
        const bool escapes = !way.flight.isScattered && !hit.isHit();
        const glm::dvec3 escaping = escapes ? throughput : before * way.flight.passing;
        if (bounce == 0) {
            result.sawBackground = escapes || way.flight.passing > 0.0;
            result.throughput = escaping;
        } else if (scene_.sky && (escapes || way.flight.passing > 0.0)) {
            result.luminance += escaping * scene_.sky->luminance(way.start.ray.direction);
        }
        if (bounce < settings_.bounces)
            result.luminance += before * lightOnWay(way, sampler);
        if (escapes || bounce == settings_.bounces)
            return result;
        FlightStart next;
        if (way.flight.isScattered)
            result.luminance += throughput * scatter(way, sampler, next);
        else
            reflect(surfaceAt(hit, way.start.ray, bounce == 0), way.start.ray, sampler, next, throughput,
                    result.luminance);
        least *= way.flight.colliding;
        if (!survives(least, throughput, sampler))
            return result;
        way.start = next;
    }
}

double PathIntegrator::opacity(const Way& way, PathSampler& sampler)
{
    if (tracker_.lastWay())
        return -std::expm1(-tracker_.lastWay()->depth());
    return 1.0 - sum(tracker_.transmittance(way.start.ray, way.start.begin, kFar, sampler)) / 3.0;
}

bool PathIntegrator::survives(double least, glm::dvec3& io, PathSampler& sampler)
{
    const double left = largest(io);
    if (left >= least)
        return left > 0.0;
    if (sampler.number() * least >= left)
        return false;
    io *= least / left;
    return true;
}

} // namespace fx::render
