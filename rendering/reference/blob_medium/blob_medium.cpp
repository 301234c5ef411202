#include "rendering/reference/blob_medium/blob_medium.h"

#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

namespace fx::render {

namespace {

double kernelAt(const Blob& blob, const glm::dvec3& position)
{
    const glm::dvec3 d = position - blob.center;
    const double q2 = glm::dot(d, d) / (blob.radius * blob.radius);
    if (q2 >= 1.0)
        return 0.0;
    const double normal = 105.0 / (32.0 * std::numbers::pi * blob.radius * blob.radius * blob.radius);
    return normal * (1.0 - q2) * (1.0 - q2);
}

/// Distance from the blob's center to the ray, and the parameter of the nearest point.
std::pair<double, double> approach(const Blob& blob, const Ray& ray)
{
    const glm::dvec3 toCenter = blob.center - ray.origin;
    const double tc = glm::dot(toCenter, ray.direction);
    return {glm::length(toCenter - tc * ray.direction), tc};
}

} // namespace

BlobMedium::BlobMedium(std::vector<Blob> blobs) : blobs_(std::move(blobs)) {}

RaySpan BlobMedium::span(const Ray& ray) const
{
    RaySpan all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Blob& blob : blobs_) {
        const auto [h, tc] = approach(blob, ray);
        if (h >= blob.radius)
            continue;
        const double w = std::sqrt((blob.radius - h) * (blob.radius + h));
        all.begin = std::min(all.begin, tc - w);
        all.end = std::max(all.end, tc + w);
    }
    return all;
}

double BlobMedium::extinctionAt(const glm::dvec3& position) const
{
    double sum = 0.0;
    for (const Blob& blob : blobs_)
        sum += blob.crossSection * kernelAt(blob, position);
    return sum;
}

glm::dvec3 BlobMedium::sourceAt(const glm::dvec3& position) const
{
    glm::dvec3 light(0.0);
    double extinction = 0.0;
    for (const Blob& blob : blobs_) {
        const double e = blob.crossSection * kernelAt(blob, position);
        light += e * blob.source;
        extinction += e;
    }
    return extinction > 0.0 ? light / extinction : glm::dvec3(0.0);
}

double BlobMedium::opticalDepth(const Ray& ray, double begin, double end) const
{
    double sum = 0.0;
    for (const Blob& blob : blobs_) {
        const auto [h, tc] = approach(blob, ray);
        sum += formula64::fxKernelOpticalDepth(blob.crossSection, blob.radius, h, tc, begin, end);
    }
    return sum;
}

glm::dvec3 marchEmission(const BlobMedium& medium, const Ray& ray, double begin, double end, int steps)
{
    const RaySpan span = medium.span(ray);
    const double first = std::max(begin, span.begin);
    const double last = std::min(end, span.end);
    glm::dvec3 light(0.0);
    double transmittance = 1.0;
    for (int i = 0; i < steps && last > first; ++i) {
        const double a = first + (last - first) * i / steps;
        const double b = first + (last - first) * (i + 1) / steps;
        const double opacity = -std::expm1(-medium.opticalDepth(ray, a, b));
        light += transmittance * opacity * medium.sourceAt(ray.origin + ray.direction * (0.5 * (a + b)));
        transmittance *= 1.0 - opacity;
    }
    return light;
}

} // namespace fx::render
