#include "rendering/reference/path/path_tracking.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

double sum(const glm::dvec3& v)
{
    return v.x + v.y + v.z;
}

/// Tentative collisions on a ray, in their order.
class TentativeCollisions
{
public:
    /// @param one [1/m] majorant for the whole ray; 0: that of each segment
    TentativeCollisions(MediumWalk& walk, const TraceRay& ray, double begin, double end, double one)
        : walk_(walk), one_(one)
    {
        walk_.start(ray, begin, end);
        isInside_ = walk_.next(segment_);
        at_ = segment_.begin;
    }
    /// @return false: the ray has left the medium
    bool next(PathSampler& sampler)
    {
        if (!isInside_)
            return false;
        at_ += freePath(sampler);
        while (at_ >= segment_.end) {
            if (!walk_.next(segment_))
                return isInside_ = false;
            if (one_ == 0.0)
                at_ = segment_.begin + freePath(sampler); // (1)
            for (; at_ < segment_.begin; ++nulls_)        // one majorant does not know where there is nothing
                at_ += freePath(sampler);
        }
        return true;
    }
    double at() const { return at_; }
    double majorant() const { return one_ > 0.0 ? one_ : segment_.majorant; }
    uint64_t nulls() const { return nulls_; } ///< collisions outside of all segments

private:
    double freePath(PathSampler& sampler) const { return -std::log1p(-sampler.number()) / majorant(); }

    MediumWalk& walk_;
    double one_, at_ = 0.0;
    MajorantSegment segment_;
    bool isInside_ = false;
    uint64_t nulls_ = 0;
};

/// Light that the medium emits along a way and does not absorb [cd/m2].
class EmissionEstimate
{
public:
    /// @param byDepth, byEmission places that are drawn by each method
    EmissionEstimate(const DepthWalk& way, uint32_t byDepth, uint32_t byEmission)
        : way_(way), byDepth_(byDepth), byEmission_(byEmission), colliding_(-std::expm1(-way.depth()))
    {}
    glm::dvec3 draw(PathSampler& sampler) const
    {
        glm::dvec3 light(0.0);
        for (uint32_t i = 0; i < std::max(byDepth_, byEmission_); ++i) {
            const auto [u, v] = sampler.pair();
            if (i < byDepth_) {
                const double depth = -std::log1p(-(i + u) / byDepth_ * colliding_);
                light += lightOf(way_.parameterAt(std::min(depth, way_.depth())));
            }
            if (i < byEmission_)
                light += lightOf(way_.emissionParameter((i + v) / byEmission_));
        }
        return light;
    }

private:
    glm::dvec3 lightOf(double t) const
    {
        const MediumPoint point = way_.at(t, 0.0);
        const double passing = std::exp(-way_.depthTo(t));
        const double p = point.extinction.x * passing / colliding_; // (3)
        const double q = sum(point.emission) / way_.emitted();
        const double densities = byDepth_ * p + byEmission_ * q;
        return densities > 0.0 ? point.emission * (passing / densities) : glm::dvec3(0.0); // (4)
    }

    const DepthWalk& way_;
    uint32_t byDepth_, byEmission_;
    double colliding_;
};

} // namespace

MediumTracker::MediumTracker(const PathMedium* medium, FlightEstimator flight, ShadowEstimator shadow)
    : shadow_(shadow)
{
    if (!medium)
        return;
    walk_ = medium->walk();
    shadowWalk_ = medium->walk();
    if (flight == FlightEstimator::Depth) {
        depthWalk_ = medium->depthWalk();
        emissionWalk_ = medium->depthWalk();
    }
    if (flight == FlightEstimator::Analog)
        majorant_ = medium->majorant();
}

Flight MediumTracker::fly(const FlightStart& start, PathSampler& sampler, glm::dvec3& io,
                          glm::dvec3& outLuminance)
{
    if (!walk_)
        return {};
    return depthWalk_ ? flyByDepth(start, sampler, io, outLuminance)
                      : flyByCollisions(start, sampler, io, outLuminance);
}

Flight MediumTracker::flyByDepth(const FlightStart& start, PathSampler& sampler, glm::dvec3& io,
                                 glm::dvec3& outLuminance)
{
    Flight flight;
    DepthWalk& way = *depthWalk_;
    way.start(start.ray, start.begin, start.end);
    const auto [u, choice] = sampler.pair();
    if (!(way.depth() > 0.0))
        return flight;
    if (way.emitted() > 0.0) {
        const double share =
            start.density > 0.0 ? start.density / (start.density + way.emissionDensity()) : 1.0;
        outLuminance +=
            io * share *
            EmissionEstimate(way, start.seenEmission, std::max(start.seenEmission, 1u)).draw(sampler);
    }
    const double colliding = start.isForced ? -std::expm1(-way.depth()) : 1.0;
    const double wanted = -std::log1p(-u * colliding); // (1)
    if (wanted >= way.depth() && !start.isForced)
        return flight;
    ++collisions_;
    flight.isScattered = true;
    flight.colliding = colliding; // (2)
    flight.passing = start.isForced ? std::exp(-way.depth()) : 0.0;
    flight.distance = way.parameterAt(std::min(wanted, way.depth()));
    const MediumPoint point = way.at(flight.distance, choice);
    flight.phase = point.phase;
    io *= point.extinction.x > 0.0 ? colliding / point.extinction.x : 0.0;
    if (!(way.emitted() > 0.0))
        outLuminance += io * point.emission; // (5)
    io *= point.scattering;
    return flight;
}

Flight MediumTracker::flyByCollisions(const FlightStart& start, PathSampler& sampler, glm::dvec3& io,
                                      glm::dvec3& outLuminance)
{
    Flight flight;
    TentativeCollisions collisions(*walk_, start.ray, start.begin, start.end, majorant_);
    while (collisions.next(sampler)) {
        ++collisions_;
        const double majorant = collisions.majorant();
        const MediumPoint point = walk_->at(collisions.at(), sampler.number());
        outLuminance += io * point.emission / majorant; // (4)
        const glm::dvec3 nulls = glm::max(majorant - point.extinction, glm::dvec3(0.0));
        const double scattering = sum(io * point.scattering);
        const double passing = sum(io * nulls);
        const double ending = majorant_ > 0.0 ? majorant * sum(io) - scattering - passing : 0.0;
        const double all = scattering + passing + std::max(ending, 0.0);
        const double number = sampler.number() * all;
        if (!(number < scattering + passing)) {
            io = glm::dvec3(0.0);
            break;
        }
        if (number < scattering) {
            io *= point.scattering * all / (majorant * scattering); // (2), (3)
            flight.isScattered = true;
            flight.distance = collisions.at();
            flight.phase = point.phase;
            break;
        }
        io *= nulls * all / (majorant * passing);
    }
    collisions_ += collisions.nulls();
    return flight;
}

glm::dvec3 MediumTracker::transmittance(const TraceRay& ray, double begin, double end, PathSampler& sampler)
{
    glm::dvec3 result(1.0);
    if (!shadowWalk_)
        return result;
    glm::dvec3 depth;
    if (shadow_ == ShadowEstimator::Exact && shadowWalk_->opticalDepth(ray, begin, end, depth))
        return glm::exp(-depth);
    TentativeCollisions collisions(*shadowWalk_, ray, begin, end, majorant_);
    while (collisions.next(sampler)) {
        ++collisions_;
        const glm::dvec3 extinction = shadowWalk_->at(collisions.at(), 0.0).extinction;
        result *= glm::max(1.0 - extinction / collisions.majorant(), glm::dvec3(0.0));
        if (shadow_ != ShadowEstimator::Delta)
            continue;
        const double passing = std::max({result.x, result.y, result.z});
        if (sampler.number() >= passing) {
            result = glm::dvec3(0.0);
            break;
        }
        result /= passing;
    }
    collisions_ += collisions.nulls();
    return result;
}

glm::dvec3 MediumTracker::emissionFrom(const TraceRay& ray, double end, double density, PathSampler& sampler)
{
    emissionWalk_->start(ray, 0.0, end);
    if (!(emissionWalk_->depth() > 0.0 && emissionWalk_->emitted() > 0.0))
        return glm::dvec3(0.0);
    return EmissionEstimate(*emissionWalk_, 0, 1).draw(sampler) /
           (density + emissionWalk_->emissionDensity());
}

} // namespace fx::render
