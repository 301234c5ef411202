#include "rendering/reference/render/scattered_light.h"

#include "rendering/optics/phase.h"
#include "rendering/reference/render/chord_depth.h"
#include "rendering/reference/trace/ray_query.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

constexpr double kCap = 0.5;        ///< [1] optical depth of a part
constexpr double kMostParts = 64.0; ///< of an interval
constexpr double kThin = 0.1;       ///< [1] optical depth below which intervals are joined
constexpr double kLeastIntervals = 24.0;
constexpr double kDarkest = 1e-6;              ///< transmittance below which nothing is seen any more
constexpr double kNode = 0.774596669241483377; ///< of Gauss-Legendre on [-1, 1]: sqrt(3/5)

} // namespace

ScatteredLight::Layers ScatteredLight::along(const TraceRay& ray, const RayHits& hits, double begin,
                                             double end)
{
    Layers light{};
    events_.clear();
    for (size_t i = 0; i < hits.size(); ++i) {
        events_.push_back(std::clamp(hits.enter[i], begin, end));
        events_.push_back(std::clamp(2.0 * hits.nearest[i] - hits.enter[i], begin, end));
    }
    std::sort(events_.begin(), events_.end());
    double from = events_.empty() ? begin : events_.front();
    const double longest = events_.empty() ? 0.0 : (events_.back() - from) / kLeastIntervals;
    for (size_t k = 1; k < events_.size(); ++k) {
        const double depth = opticalDepthOf(medium_, hits, from, events_[k]);
        const bool isLast = k + 1 == events_.size();
        if (!isLast && depth < kThin && events_[k + 1] - from < longest)
            continue; // kernels begin smoothly: thin intervals are taken together
        if (depth > 0.0) {
            if (std::exp(-opticalDepthOf(medium_, hits, begin, from)) < kDarkest)
                break;
            addInterval(ray, hits, begin, {from, events_[k], depth}, light);
        }
        from = events_[k];
    }
    return light;
}

void ScatteredLight::addInterval(const TraceRay& ray, const RayHits& hits, double begin,
                                 const Interval& interval, Layers& io)
{
    const int parts = int(std::clamp(std::ceil(interval.depth / kCap), 1.0, kMostParts));
    const double length = (interval.to - interval.from) / parts;
    for (int part = 0; part < parts; ++part)
        addPart(ray, hits, begin, interval.from + length * part, interval.from + length * (part + 1), io);
}

void ScatteredLight::addPart(const TraceRay& ray, const RayHits& hits, double begin, double from, double to,
                             Layers& io)
{
    const double middle = 0.5 * (from + to);
    const double half = 0.5 * (to - from);
    for (const int side : {-1, 0, 1}) {
        const double t = middle + half * kNode * side;
        const double seen = std::exp(-opticalDepthOf(medium_, hits, begin, t));
        addNode(ray, hits, t, half * seen * (side == 0 ? 8.0 : 5.0) / 9.0, io); // (2)
    }
}

double ScatteredLight::transmittance(const glm::dvec3& point, const glm::dvec3& direction, double distance)
{
    const TraceRay shadow{point, direction};
    if (opaque_.blocks(shadow, distance, shadowHits_))
        return 0.0;
    findHits(medium_.tree(), shadow, 0.0, distance, shadowHits_);
    return std::exp(-opticalDepthOf(medium_, shadowHits_, 0.0, distance));
}

void ScatteredLight::addNode(const TraceRay& ray, const RayHits& hits, double t, double weight, Layers& io)
{
    const glm::dvec3 point = ray.origin + ray.direction * t;
    const auto scatter = [&](const glm::dvec3& direction, const glm::dvec3& illuminance, double distance) {
        const glm::dvec3 arriving = illuminance * (weight * transmittance(point, direction, distance));
        const double cosine = glm::dot(ray.direction, direction); // 1: looking into the light
        for (size_t i = 0; i < hits.size(); ++i) {
            const double extinction = BlobChord(medium_.blob(hits.place[i]), hits, i).extinction(t);
            if (!(extinction > 0.0))
                continue;
            const MediumView::Scattering& s = medium_.scattering(hits.place[i]);
            const double phase = double(henyeyGreenstein(float(cosine), s.anisotropy));
            io[size_t(s.layer)] += arriving * glm::dvec3(s.albedo) * (extinction * phase); // (1)
        }
    };
    const Lighting& lighting = opaque_.scene().lighting;
    if (lighting.sunIlluminance != glm::vec3(0.0f))
        scatter(glm::dvec3(lighting.sunDirection), glm::dvec3(lighting.sunIlluminance), 1e30);
    for (const EffectLight& fire : opaque_.scene().lights) {
        const glm::dvec3 toLight = fire.position - opaque_.eye() - point;
        const double distance = glm::length(toLight);
        const double radius = double(fire.radius);
        if (distance > 0.0)
            scatter(toLight / distance, glm::dvec3(fire.intensity) / (distance * distance + radius * radius),
                    std::max(distance - radius, 0.0));
    }
}

} // namespace fx::render
