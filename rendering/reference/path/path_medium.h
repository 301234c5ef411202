/// @file path_medium.h
/// Interface of participating media for the path tracer.
#pragma once

#include "rendering/reference/path/path_phase.h"
#include "rendering/reference/trace/ray_grid.h"

#include <glm/vec3.hpp>

#include <array>
#include <memory>
#include <utility>

namespace fx::render {

/// Optical properties of a medium at a point.
struct MediumPoint
{
    glm::dvec3 extinction{0.0}; ///< [1/m] extinction of each color channel, >= 0
    /// [1/m] scattering of each color channel; an expected value over the random choice of `phase`, see
    /// MediumWalk::at()
    glm::dvec3 scattering{0.0};
    glm::dvec3 emission{0.0}; ///< [cd/m2 per m]
    PhaseFunction phase;
};

/// A segment of a ray with an upper bound of the extinction.
struct MajorantSegment
{
    double begin = 0.0, end = 0.0; ///< [m] ray parameters
    double majorant = 0.0;         ///< [1/m] upper bound of the extinction of all channels on the segment
};

/// Divides rays through a medium into segments. Each thread needs its own object.
class MediumWalk
{
public:
    virtual ~MediumWalk() = default;
    /// Begins a new ray between two ray parameters.
    /// @param end [m] may be infinite
    virtual void start(const TraceRay& ray, double begin, double end) = 0;
    /// Returns the next segment along the ray. There is no medium between segments.
    /// @return false if the ray has left the medium
    virtual bool next(MajorantSegment& out) = 0;
    /// The medium at a parameter of the last segment of next().
    /// @param choice random number in [0, 1), which selects one of several phase functions where substances
    ///         mix. `scattering` is divided by the probability of the selection
    virtual MediumPoint at(double parameter, double choice) = 0;
    /// Optical depth of each channel between two parameters of `ray`, if it has a closed form.
    /// @return false if there is no closed form, so that the transmittance must be estimated
    virtual bool opticalDepth(const TraceRay& ray, double begin, double end, glm::dvec3& out) = 0;
};

/// A ray through a medium whose optical depth has a closed form and is the same for all color channels. Each
/// thread needs its own object.
class DepthWalk
{
public:
    virtual ~DepthWalk() = default;

    /// Begins a new ray between two ray parameters.
    /// @param end [m] may be infinite
    virtual void start(const TraceRay& ray, double begin, double end) = 0;

    /// [1] Optical depth between the parameters `begin` and `end` of start().
    virtual double depth() const = 0;

    /// [1] Optical depth from `begin` to `parameter`.
    virtual double depthTo(double parameter) const = 0;

    /// The ray parameter at which depthTo() is `depth`.
    /// @param depth [1] 0..depth()
    virtual double parameterAt(double depth) const = 0;

    /// The medium at a parameter of the ray. @param choice see MediumWalk::at()
    virtual MediumPoint at(double parameter, double choice) const = 0;

    /// [m] Range of the ray outside of which there is no medium; empty if `second` <= `first`.
    virtual std::pair<double, double> extent() const = 0;

    /// [cd/m2] Integral of the emission over the ray, summed over the channels. 0 if sampling emission at
    /// collisions is sufficient.
    virtual double emitted() const = 0;

    /// Samples a ray parameter with a probability density proportional to the emission. Requires emitted() >
    /// 0.
    /// @param u random number in [0, 1)
    virtual double emissionParameter(double u) const = 0;

    /// [1/sr] Probability density with which PathMedium::emissionDirection() samples the direction of the ray
    /// at its origin, times emissionChance() at the origin. The ray must begin at its origin.
    virtual double emissionDensity() const = 0;
};

/// A participating medium. The medium and the rays use the same coordinates. Threads: any thread may call
/// const functions.
class PathMedium
{
public:
    virtual ~PathMedium() = default;
    virtual std::unique_ptr<MediumWalk> walk() const = 0;

    /// Returns an object for rays through the medium; null if optical depths have no closed form or differ
    /// between color channels.
    virtual std::unique_ptr<DepthWalk> depthWalk() const { return nullptr; }

    /// [1] Probability with which a direction of emissionDirection() should be sampled at a point. If it is
    /// 0, emissionDirection() must not be called.
    virtual double emissionChance(const glm::dvec3& /*position*/) const { return 0.0; }

    /// Samples a direction from `position` to emitting medium. DepthWalk::emissionDensity() is its density.
    /// @param u three random numbers in [0, 1)
    virtual glm::dvec3 emissionDirection(const glm::dvec3& /*position*/,
                                         const std::array<double, 3>& /*u*/) const
    {
        return {0.0, 1.0, 0.0};
    }

    /// [1/m] Upper bound of the extinction everywhere, for tracking without local majorants.
    virtual double majorant() const = 0;
};

} // namespace fx::render
