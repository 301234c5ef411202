/// @file path_medium.h
/// What the path tracer asks of a participating medium.
#pragma once

#include "rendering/reference/path/path_phase.h"
#include "rendering/reference/trace/ray_grid.h"

#include <glm/vec3.hpp>

#include <memory>

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
    /// Turns to a new ray. @param end [m] may be infinite
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

/// A medium. Coordinates are those of the rays it is asked for. Const calls from any thread.
class PathMedium
{
public:
    virtual ~PathMedium() = default;
    virtual std::unique_ptr<MediumWalk> walk() const = 0;
};

} // namespace fx::render
