/// @file seen_depth.h
/// How far away the medium is that a ray sees.
#pragma once

#include "rendering/reference/render/medium_view.h"
#include "rendering/reference/trace/ray_hits.h"

namespace fx::render {

/// @formula seen-depth
/// Mean distance of the medium along a ray, each place weighted by how much of it is seen.
///
/// symbol   unit   meaning
///   t        m      ray parameter; a, b where the medium begins and ends on the visible ray
///   rho      1/m    extinction; T = exp(-integral of rho from a to t) the transmittance up to t
///   A        1      opacity, 1 - T(b)
///   z        m      the mean distance
/// @derivation
///   z = (1/A) integral over [a, b] of t rho T dt, and rho T = -dT/dt                            (1)
///   By parts: z = (1/A) (a - b T(b) + integral of T dt)                                        (2)
///   and with 1 - T under the integral, so that nothing cancels for thin media:
///       z = b - (1/A) integral over [a, b] of (1 - T) dt                                       (3)
/// @source    elementary; no publication needed
/// @deviation (3) is summed at the middles of 64 equal steps, T from the blobs' exact polynomials
/// @valid     A > 0
/// @accuracy  |error| <= (b - a) / 128, reached only where a sharp front hides all behind it
/// @tests     tests/rendering/reference/render/test_seen_depth.cpp
///
struct MediumDepth
{
    double distance;     ///< [m] z; +infinity when the ray sees no medium
    double opticalDepth; ///< [1] of the whole visible ray, exact
};

/// One for each thread.
class SeenDepth
{
public:
    /// @param hits blobs of `medium` that the ray meets between its parameters `begin` and `end`
    MediumDepth along(const MediumView& medium, const RayHits& hits, double begin, double end);

    static constexpr int kSteps = 64;

private:
    std::array<double, kSteps> depth_;      ///< [1] from a to the middle of each step, of blobs around it
    std::array<double, kSteps + 1> passed_; ///< [1] of blobs that end before the middle of this step
};

} // namespace fx::render
