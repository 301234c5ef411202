/// @file path_statistics.h
/// Mean and standard error of random numbers, and free paths of light through a medium.
#pragma once

#include "rendering/reference/path/path_tracking.h"

#include <cmath>
#include <cstdint>

namespace fx::render {

/// Mean and standard error of numbers, updated by the method of [Wel62].
class Statistics
{
public:
    void add(double value)
    {
        ++count_;
        const double change = value - mean_;
        mean_ += change / double(count_);
        squares_ += change * (value - mean_);
    }
    double mean() const { return mean_; }
    double variance() const { return count_ > 1 ? squares_ / double(count_ - 1) : 0.0; }
    double error() const { return std::sqrt(variance() / double(count_)); }

private:
    uint64_t count_ = 0;
    double mean_ = 0.0, squares_ = 0.0;
};

/// Result of a path through a medium.
struct Escape
{
    bool isOut = false;
    uint32_t scatterings = 0;
    TraceRay ray{}; ///< ray of the last free path
    glm::dvec3 throughput{1.0};
    glm::dvec3 luminance{0.0}; ///< light emitted along the path
};

/// Traces a path until it leaves the medium or its throughput is below `least`.
inline Escape escape(MediumTracker& tracker, TraceRay ray, PathSampler& sampler, double least = 1e-9)
{
    Escape result;
    for (;; ++result.scatterings) {
        result.ray = ray;
        const Flight flight = tracker.fly({ray}, sampler, result.throughput, result.luminance);
        if (!flight.isScattered) {
            result.isOut = true;
            return result;
        }
        if (!(result.throughput.x > least))
            return result;
        const auto [u, turn] = sampler.pair();
        ray = {ray.origin + ray.direction * flight.distance,
               PhaseFunction::around(ray.direction, flight.phase.cosine(u), turn)};
    }
}

} // namespace fx::render
