#include "rendering/reference/path/path_integrator.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr double kInvPi = std::numbers::inv_pi;

double largest(const glm::dvec3& v)
{
    return std::max({v.x, v.y, v.z});
}

double sum(const glm::dvec3& v)
{
    return v.x + v.y + v.z;
}

/// Way to the next tentative collision [m].
double freePath(double majorant, PathSampler& sampler)
{
    return -std::log1p(-sampler.number()) / majorant;
}

double largestMajorant(MediumWalk& walk, const TraceRay& ray, double begin, double end)
{
    double majorant = 0.0;
    walk.start(ray, begin, end);
    for (MajorantSegment segment; walk.next(segment);)
        majorant = std::max(majorant, segment.majorant);
    return majorant;
}

} // namespace

PathIntegrator::PathIntegrator(const PathScene& scene, const PathSettings& settings)
    : scene_(scene), settings_(settings)
{
    if (scene_.medium) {
        walk_ = scene_.medium->walk();
        shadowWalk_ = scene_.medium->walk();
    }
}

Flight PathIntegrator::fly(const TraceRay& ray, double begin, double end, PathSampler& sampler,
                           glm::dvec3& io, glm::dvec3& outLuminance)
{
    Flight flight;
    if (!walk_)
        return flight;
    const bool isPlain = settings_.flight == FlightEstimator::OneMajorant;
    const double bound = isPlain ? largestMajorant(*walk_, ray, begin, end) : 0.0;
    walk_->start(ray, begin, end);
    double last = -1.0; // end of the segment before
    for (MajorantSegment segment; walk_->next(segment);) {
        if (isPlain && last >= 0.0) // plain tracking does not know where there is nothing
            for (double t = last + freePath(bound, sampler); t < segment.begin; t += freePath(bound, sampler))
                ++collisions_;
        last = segment.end;
        const double majorant = std::max(bound, segment.majorant);
        for (double t = segment.begin + freePath(majorant, sampler); t < segment.end;
             t += freePath(majorant, sampler))
        { // (1)
            ++collisions_;
            const MediumPoint point = walk_->at(t, sampler.number());
            outLuminance += io * point.emission / majorant; // (4)
            const glm::dvec3 nulls = glm::max(majorant - point.extinction, glm::dvec3(0.0));
            const double scattering = sum(io * point.scattering);
            const double passing = sum(io * nulls);
            if (!(scattering + passing > 0.0)) {
                io = glm::dvec3(0.0);
                return flight;
            }
            const double share = scattering / (scattering + passing); // (2)
            if (sampler.number() < share) {
                io *= point.scattering / (majorant * share); // (3)
                flight = {true, t, point.phase};
                return flight;
            }
            io *= nulls / (majorant * (1.0 - share));
        }
    }
    return flight;
}

glm::dvec3 PathIntegrator::transmittance(const TraceRay& ray, double begin, double end, PathSampler& sampler)
{
    glm::dvec3 result(1.0);
    if (!shadowWalk_)
        return result;
    glm::dvec3 depth;
    if (settings_.shadow == ShadowEstimator::Exact && shadowWalk_->opticalDepth(ray, begin, end, depth))
        return glm::exp(-depth);
    shadowWalk_->start(ray, begin, end);
    for (MajorantSegment segment; shadowWalk_->next(segment);) {
        const double majorant = segment.majorant;
        for (double t = segment.begin + freePath(majorant, sampler); t < segment.end;
             t += freePath(majorant, sampler))
        {
            ++collisions_;
            result *= glm::max(1.0 - shadowWalk_->at(t, 0.0).extinction / majorant, glm::dvec3(0.0));
            if (settings_.shadow != ShadowEstimator::Delta)
                continue;
            const double passing = largest(result);
            if (sampler.number() >= passing)
                return glm::dvec3(0.0);
            result /= passing;
        }
    }
    return result;
}

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
    return sample.illuminance * transmittance(shadow, 0.0, sample.distance, sampler);
}

glm::dvec3 PathIntegrator::lightAt(const glm::dvec3& position, const glm::dvec3& direction,
                                   const PhaseFunction& phase, PathSampler& sampler)
{
    glm::dvec3 light(0.0);
    for (const PathLight* source : scene_.lights) {
        const LightSample sample = source->sample(position, sampler.pair());
        const double share = phase.at(glm::dot(direction, sample.direction));
        if (largest(sample.illuminance) * share > 0.0)
            light += share * arriving(sample, position, sampler);
    }
    return light;
}

void PathIntegrator::reflect(const SurfaceHit& hit, TraceRay& ray, PathSampler& sampler, glm::dvec3& io,
                             glm::dvec3& outLuminance)
{
    glm::dvec3 normal = glm::normalize(interpolate(scene_.mesh.normals, hit));
    if (glm::dot(normal, ray.direction) > 0.0)
        normal = -normal;
    const glm::dvec3 position =
        ray.origin + ray.direction * hit.distance + normal * (kSurfaceLift * hit.distance);
    io *= interpolate(scene_.mesh.colors, hit);
    for (const PathLight* source : scene_.lights) {
        const LightSample sample = source->sample(position, sampler.pair());
        const double cosine = glm::dot(normal, sample.direction);
        if (largest(sample.illuminance) * cosine > 0.0)
            outLuminance += io * (cosine * kInvPi) * arriving(sample, position, sampler);
    }
    const auto [u, turn] = sampler.pair();
    ray = {position, PhaseFunction::around(normal, std::sqrt(1.0 - u), turn)}; // density cosine / pi
}

PathResult PathIntegrator::trace(const TraceRay& camera, double begin, PathSampler& sampler)
{
    PathResult result;
    TraceRay ray = camera;
    glm::dvec3 throughput(1.0);
    for (uint32_t bounce = 0;; ++bounce) {
        const SurfaceHit hit = surface(ray, begin);
        if (bounce == 0)
            result.opacity =
                hit.isHit() ? 1.0 : 1.0 - sum(transmittance(ray, begin, hit.distance, sampler)) / 3.0;
        const Flight flight = fly(ray, begin, hit.distance, sampler, throughput, result.luminance);
        const bool escapes = !flight.isScattered && !hit.isHit();
        if (escapes && bounce == 0) {
            result.sawBackground = true;
            result.throughput = throughput;
        } else if (escapes && scene_.sky)
            result.luminance += throughput * scene_.sky->luminance(ray.direction);
        if (escapes || bounce == settings_.bounces)
            return result;
        if (flight.isScattered) {
            const glm::dvec3 position = ray.origin + ray.direction * flight.distance;
            result.luminance += throughput * lightAt(position, ray.direction, flight.phase, sampler);
            const auto [u, turn] = sampler.pair();
            ray = {position, PhaseFunction::around(ray.direction, flight.phase.cosine(u), turn)};
        } else {
            reflect(hit, ray, sampler, throughput, result.luminance);
        }
        begin = 0.0;
        const double left = largest(throughput);
        if (!(left > 0.0))
            return result;
        if (left < settings_.roulette) {
            if (sampler.number() * settings_.roulette >= left)
                return result;
            throughput *= settings_.roulette / left;
        }
    }
}

} // namespace fx::render
