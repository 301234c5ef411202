#include "rendering/reference/render/scattered_light.h"

#include "rendering/optics/phase.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

constexpr double kCap = 0.5;       ///< [1] optical depth of a part
constexpr double kMaxParts = 64.0; ///< of an interval
constexpr double kThin = 0.1;      ///< [1] optical depth below which intervals are joined
constexpr double kMinIntervals = 24.0;
constexpr double kDarkest = 1e-6;              ///< transmittance below which nothing is seen any more
constexpr double kNode = 0.774596669241483377; ///< of Gauss-Legendre on [-1, 1]: sqrt(3/5)
constexpr double kWidest = 0.4;                ///< [rad] of a part as a lamp sees it
constexpr double kPerLump = 0.25;              ///< longest piece over the size of the largest lumps
constexpr double kMaxLumps = 1024.0;
constexpr double kGrowth = 3.0; ///< of the distance from a lamp within a piece
/// Shifts the directions of the sky from node to node: the powers of 1 / x with x^3 = x + 1.
constexpr glm::dvec2 kLattice{0.754877666246692760, 0.569840290998053266};

/// Calls add(place, weight) for the three nodes of [from, to].
template <class Add>
void integrate(double from, double to, const Add& add)
{
    const double middle = 0.5 * (from + to);
    const double half = 0.5 * (to - from);
    for (const int side : {-1, 0, 1})
        add(middle + half * kNode * side, half * (side == 0 ? 8.0 : 5.0) / 9.0);
}

} // namespace

ScatteredLight::Layers ScatteredLight::along(const TraceRay& trace, const RayHits& hits, double begin,
                                             double end)
{
    Layers light{};
    const Ray ray{trace, hits, begin};
    node_ = 0;
    if (medium_.details().isGiven())
        detailed_.trace(trace, hits, begin, end);
    findEvents(ray, end);
    double from = events_.empty() ? begin : events_.front();
    const double longest = events_.empty() ? 0.0 : (events_.back() - from) / kMinIntervals;
    for (size_t k = 1; k < events_.size(); ++k) {
        const double depth = opticalDepth(ray, from, events_[k]);
        const bool isLast = k + 1 == events_.size();
        if (!isLast && depth < kThin && events_[k + 1] - from < longest)
            continue; // kernels begin smoothly: thin intervals are taken together
        if (depth > 0.0) {
            if (std::exp(-opticalDepth(ray, begin, from)) < kDarkest)
                break;
            addInterval(ray, {from, events_[k]}, light);
        }
        from = events_[k];
    }
    return light;
}

/// Places where blobs begin and end, and with detail also every quarter of a lump.
void ScatteredLight::findEvents(const Ray& ray, double end)
{
    events_.clear();
    for (size_t i = 0; i < ray.hits.size(); ++i) {
        events_.push_back(std::clamp(ray.hits.enter[i], ray.begin, end));
        events_.push_back(std::clamp(2.0 * ray.hits.nearest[i] - ray.hits.enter[i], ray.begin, end));
    }
    std::sort(events_.begin(), events_.end());
    const DetailedMedium& details = medium_.details();
    if (!details.isGiven() || events_.empty())
        return;
    double spacing = events_.back() - events_.front();
    for (size_t i = 0; i < ray.hits.size(); ++i)
        if (const int32_t group = details.groupOf(ray.hits.place[i]); group >= 0)
            spacing = std::min(spacing, kPerLump * details.lumpSize(size_t(group)));
    const double first = events_.front(), length = events_.back() - first;
    const double parts = std::min(std::ceil(length / spacing), kMaxLumps);
    for (double k = 1.0; k < parts; k += 1.0)
        events_.push_back(first + length * k / parts);
    std::sort(events_.begin(), events_.end());
}

double ScatteredLight::opticalDepth(const Ray& ray, double from, double to) const
{
    return medium_.details().isGiven() ? detailed_.opticalDepth(from, to)
                                       : opticalDepthOf(medium_, ray.hits, from, to);
}

void ScatteredLight::addInterval(const Ray& ray, const Interval& interval, Layers& io)
{
    if (lights_.hasSun() || lights_.hasSky())
        addParts(ray, interval, kDistant, io);
    for (size_t lamp = 0; lamp < lights_.lampCount(); ++lamp) {
        lights_.course(lamp, ray.ray, course_);
        double from = interval.from;
        for (const double cut : course_.cuts)
            if (cut > from && cut < interval.to) {
                addParts(ray, {from, cut}, lamp, io);
                from = cut;
            }
        addParts(ray, {from, interval.to}, lamp, io);
    }
}

void ScatteredLight::addParts(const Ray& ray, const Interval& interval, size_t lamp, Layers& io)
{
    const double depth = opticalDepth(ray, interval.from, interval.to);
    const int parts = int(std::clamp(std::ceil(depth / kCap), 1.0, kMaxParts));
    const double length = (interval.to - interval.from) / parts;
    for (int part = 0; part < parts; ++part) {
        const Interval piece{interval.from + length * part, interval.from + length * (part + 1)};
        if (lamp == kDistant)
            addPart(ray, piece, io);
        else
            addLampPart(ray, piece, lamp, io);
    }
}

void ScatteredLight::addPart(const Ray& ray, const Interval& part, Layers& io)
{
    integrate(part.from, part.to,
              [&](double t, double length) { addNode(ray, t, length, kDistant, io); }); // (3)
}

void ScatteredLight::addLampPart(const Ray& ray, const Interval& part, size_t lamp, Layers& io)
{
    // All of the part is on one side of the place nearest to the lamp. Far from the lamp the medium changes
    // within small angles, so that pieces grow with the distance by no more than a factor.
    const double d = course_.distance;
    const bool isBehind = part.to > course_.nearest;
    double from = std::abs((isBehind ? part.from : part.to) - course_.nearest);
    const double end = std::abs((isBehind ? part.to : part.from) - course_.nearest);
    while (from < end) {
        const double to = std::min(end, std::max(kGrowth * from, d));
        const double first = std::atan(from / d), last = std::atan(to / d);
        const int slices = std::max(1, int(std::ceil((last - first) / kWidest)));
        const double slice = (last - first) / slices;
        for (int i = 0; i < slices; ++i)
            integrate(first + slice * i, first + slice * (i + 1), [&](double angle, double weight) {
                const double tangent = std::tan(angle);
                addNode(ray, course_.nearest + (isBehind ? d : -d) * tangent,
                        weight * d * (1.0 + tangent * tangent), lamp, io); // (4)
            });
        from = to;
    }
}

glm::dvec3 ScatteredLight::inflow(const glm::dvec3& look, float anisotropy) const
{
    glm::dvec3 light(0.0), sky(0.0);
    double all = 0.0;
    for (size_t i = 0; i < arriving_.size(); ++i) {
        const double cosine = glm::dot(look, arriving_[i].direction); // 1: looking into the light
        const double phase = double(henyeyGreenstein(float(cosine), anisotropy));
        if (i < firstOfSky_) {
            light += phase * arriving_[i].illuminance;
            continue;
        }
        sky += phase * arriving_[i].illuminance;
        all += phase * arriving_[i].solidAngle;
    }
    return all > 0.0 ? light + sky / all : light; // (2)
}

void ScatteredLight::addNode(const Ray& ray, double t, double length, size_t lamp, Layers& io)
{
    const glm::dvec3 point = ray.ray.origin + ray.ray.direction * t;
    const glm::dvec2 shift = glm::fract(double(node_++) * kLattice);
    arriving_.clear();
    if (lamp != kDistant)
        lights_.appendLamp(lamp, point, shift.x, arriving_);
    else if (lights_.hasSun())
        arriving_.push_back(lights_.sun());
    firstOfSky_ = arriving_.size();
    if (lamp == kDistant && lights_.hasSky())
        lights_.appendSky(shift, 1, arriving_);
    const double weight = length * std::exp(-opticalDepth(ray, ray.begin, t));
    for (ArrivingLight& light : arriving_)
        if (light.illuminance != glm::dvec3(0.0))
            light.illuminance *= weight * shadow_.visibility({point, light.direction}, light.distance);

    const bool isDetailed = medium_.details().isGiven();
    if (isDetailed)
        detailed_.look(t);
    glm::dvec3 light(0.0);
    float anisotropy = 2.0f; // of `light`; 2: none yet
    for (size_t i = 0; i < ray.hits.size(); ++i) {
        const double extinction = BlobChord(medium_.blob(ray.hits.place[i]), ray.hits, i).extinction(t) *
                                  (isDetailed ? detailed_.share(i) : 1.0);
        if (!(extinction > 0.0))
            continue;
        const MediumView::Scattering& s = medium_.scattering(ray.hits.place[i]);
        if (s.anisotropy != anisotropy) {
            anisotropy = s.anisotropy;
            light = inflow(ray.ray.direction, anisotropy);
        }
        const glm::dvec3 albedo(s.albedo);
        io[size_t(s.layer)] +=
            light * (isDetailed ? detailed_.albedo(i, albedo) : albedo) * extinction; // (1)
    }
}

} // namespace fx::render
