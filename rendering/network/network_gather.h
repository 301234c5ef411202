/// @file network_gather.h
/// Light that a medium sends to an eye, from the light in a network's cells.
#pragma once

#include "rendering/network/network_phase.h"
#include "rendering/network/network_state.h"

namespace fx::render {

/// @formula network-gather
/// Light along a ray of the eye through a medium in whose network light is at rest.
///
/// symbol     unit   meaning
///   k, s     1/m, m extinction; way along the ray
///   T, T'    1      transmittance to the eye with k, and with k' = k (1 - albedo f)
///   f, g_l   1      of network-phase; b = albedo (1 - f)
///   P, H_N   1/sr   the series of network-phase; Henyey and Greenstein's function with g^N
///   t, X     1      optical depth from the light to the place, and from there on to the eye as well
///   F        lx     of the light without the medium
///   J_k, Y_k        moments of the network's cells, harmonics of the direction to the eye
///   E        cd/m2  emission per optical depth
/// @derivation
///   dL = k ds (T' (b P exp(-(1 - albedo f) t) F + b sum of g_l J_k Y_k + E)                     (1)
///            + T exp(-t) F / X sum over N from 1 on of (albedo X)^N / N! R_N)                   (2)
///   (1) is the medium without its forward peak. In the bands of the series it is exact. What it lacks in the
///   bands beyond, light has that is scattered N times through small angles, nearly on its straight way: N
///   scatterings multiply band l of the phase function to g^(l N), those of (1) to h_l^N with
///   h_l = f + (1 - f) g_l, and the peak itself has f^N in each band,
///       R_N = H_N - sum over l of (2 l + 1) / (4 pi) (h_l^N - f^N) P_l(c)                       (3)
///   The way has X^N / N! places for N scatterings. As each of them may be the one at the place, (2) is its
///   N-th part. N = 1 makes single scattering exact. Beyond N = 16 there is next to nothing      (4)
///   (2) is negative at the sides, and held above minus the first part of (1)                    (5)
///   What stands behind is seen through T'.
/// @source    [JWW76] (1); [VDH80] small angles; the rest is own
/// @deviation (4), (5)
/// @valid     any
/// @accuracy  see docs/howto/illumination-network.md
/// @tests     tests/rendering/network/test_network_gather.cpp
struct GatherPoint
{
    double albedo = 0.0;     ///< [1]
    double lightDepth = 0.0; ///< [1] t
    double eyeDepth = 0.0;   ///< [1] between place and eye
    double cosine = 0.0;     ///< [1] between the way of the light and the direction to the eye
    double irradiance = 0.0; ///< [lx] F
};

/// Two parts of the light per k ds: behind T and behind T'.
struct GatheredLight
{
    double plain = 0.0;  ///< [cd/m2] (2)
    double scaled = 0.0; ///< [cd/m2] first part of (1)
};

GatheredLight gatherUnscattered(const NetworkPhase& phase, const GatherPoint& point);
/// [cd/m2] second part of (1). @param toEye unit, the way the light goes
double gatherScattered(const NetworkPhase& phase, double albedo, const NetworkState& state,
                       const glm::dvec3& position, const glm::dvec3& toEye);

} // namespace fx::render
