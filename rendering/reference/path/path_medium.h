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

/// A medium at one point.
struct MediumPoint
{
    glm::dvec3 extinction{0.0}; ///< [1/m] of each color channel, >= 0
    glm::dvec3 scattering{0.0}; ///< [1/m] its mean over the choice of `phase`, see MediumWalk::at()
    glm::dvec3 emission{0.0};   ///< [cd/m2 per m]
    PhaseFunction phase;
};

/// Part of a ray over which the extinction has an upper bound.
struct MajorantSegment
{
    double begin = 0.0, end = 0.0; ///< [m] ray parameters
    double majorant = 0.0;         ///< [1/m] >= the extinction of every channel on the segment
};

/// Follows rays through a medium. One for each thread.
class MediumWalk
{
public:
    virtual ~MediumWalk() = default;
    /// Begins a new ray. @param end [m] may be infinite
    virtual void start(const TraceRay& ray, double begin, double end) = 0;
    /// The next segment in the order of the ray; between segments there is no medium.
    /// @return false: the ray has left the medium
    virtual bool next(MajorantSegment& out) = 0;
    /// The medium at a parameter of the segment that next() returned last.
    /// @param choice in [0, 1): picks the phase function where several substances mix; `scattering` is then
    /// divided by
    ///   the probability of the choice
    virtual MediumPoint at(double parameter, double choice) = 0;
    /// Optical depth of each channel between two parameters of `ray`, where the medium can integrate it.
    /// @return false: it cannot, and the transmittance is to be estimated
    virtual bool opticalDepth(const TraceRay& ray, double begin, double end, glm::dvec3& out) = 0;
};

/// A ray through a medium whose optical depth is known in closed form and the same for all color channels.
/// One for each thread.
class DepthWalk
{
public:
    virtual ~DepthWalk() = default;

    /// Turns to a new ray. @param end [m] may be infinite
    virtual void start(const TraceRay& ray, double begin, double end) = 0;

    /// [1] optical depth between the two parameters of start()
    virtual double depth() const = 0;

    /// [1] optical depth from the first of them to `parameter`
    virtual double depthTo(double parameter) const = 0;

    /// The parameter at which depthTo() is `depth`. @param depth [1] 0..depth()
    virtual double parameterAt(double depth) const = 0;

    /// The medium at a parameter of the ray; see MediumWalk::at() for `choice`
    virtual MediumPoint at(double parameter, double choice) const = 0;

    /// [m] interval of the path outside of which there is no medium; empty if `second` <= `first`
    virtual std::pair<double, double> extent() const = 0;

    /// [cd/m2] integral over the way of the emitted light, summed over the channels; 0 if emission is sampled
    /// well enough by collisions
    virtual double emitted() const = 0;

    /// A parameter that is distributed as the emitted light. @param u in [0, 1); emitted() is not 0
    virtual double emissionParameter(double u) const = 0;

    /// [1/sr] with which PathMedium::emissionDirection() draws the direction of the ray at its origin, times
    /// emissionChance() there; the ray has to begin there
    virtual double emissionDensity() const = 0;
};

/// A medium. Coordinates are those of the rays. Const calls from any thread.
class PathMedium
{
public:
    virtual ~PathMedium() = default;
    virtual std::unique_ptr<MediumWalk> walk() const = 0;

    /// Null where optical depths have no closed form or differ between color channels.
    virtual std::unique_ptr<DepthWalk> depthWalk() const { return nullptr; }

    /// [1] how often a direction of emissionDirection() is to be drawn at a place; 0: never, and that
    /// function is not to be called
    virtual double emissionChance(const glm::dvec3& /*position*/) const { return 0.0; }

    /// A direction from `position` in which the medium emits; DepthWalk::emissionDensity() is its density.
    /// @param u three numbers in [0, 1)
    virtual glm::dvec3 emissionDirection(const glm::dvec3& /*position*/,
                                         const std::array<double, 3>& /*u*/) const
    {
        return {0.0, 1.0, 0.0};
    }

    /// [1/m] an upper bound of the extinction everywhere, for tracking without local majorants
    virtual double majorant() const = 0;
};

} // namespace fx::render
