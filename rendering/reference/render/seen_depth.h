/// @file seen_depth.h
/// Computes the mean distance of the visible medium along a ray.
#pragma once

#include "rendering/reference/render/medium_view.h"
#include "rendering/reference/trace/ray_hits.h"

namespace fx::render {

/// @formula seen-depth
/// Mean distance of the medium along a ray, weighted by visible opacity.
///
/// symbol   unit   meaning
///   t        m      ray parameter; a, b begin and end of the medium on the visible ray
///   rho      1/m    extinction; T = exp(-integral of rho from a to t) the transmittance up to t
///   A        1      opacity, 1 - T(b)
///   z        m      mean distance
/// @derivation
///   z = (1/A) integral over [a, b] of t rho T dt, and rho T = -dT/dt                            (1)
///   Integration by parts: z = (1/A) (a - b T(b) + integral of T dt)                            (2)
///   Equal to (2), but without cancellation for thin media:
///       z = b - (1/A) integral over [a, b] of (1 - T) dt                                       (3)
/// @source    elementary; no publication needed
/// @deviation (3) is summed at the midpoints of 64 equal steps; T is exact
/// @valid     A > 0
/// @accuracy  |error| <= (b - a) / 128, reached only by an opaque front of no thickness
/// @tests     tests/rendering/reference/render/test_seen_depth.cpp
///
struct MediumDepth
{
    double distance;     ///< [m] mean distance z; +infinity without visible medium
    double opticalDepth; ///< [1] optical depth of the whole visible ray; exact
};

/// Computes distance and optical depth along rays. Each thread needs its own object.
class SeenDepth
{
public:
    /// Computes distance and optical depth of the medium along a ray.
    /// @param hits blobs of `medium` that the ray meets between its parameters `begin` and `end`
    MediumDepth along(const MediumView& medium, const RayHits& hits, double begin, double end);

    static constexpr int kSteps = 64;

private:
    /// [1] by step: optical depth of blobs that contain the step's midpoint, from the beginning of the medium
    /// to this midpoint
    std::array<double, kSteps> depth_;
    /// [1] by step: optical depth of blobs that end before the step's midpoint
    std::array<double, kSteps + 1> passed_;
};

} // namespace fx::render
