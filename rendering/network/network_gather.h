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
///   P, P'    1/sr   Henyey and Greenstein's function with g, and with g_1
///   t        1      optical depth from the light to the place
///   F        lx     of the light without the medium
///   J_k, Y_k        moments of the network's cells, harmonics of the direction to the eye
///   E        cd/m2  emission per optical depth
/// @derivation
///   dL = k ds (T exp(-t) F (albedo P - b P')                                                    (1)
///            + T' b (P' exp(-(1 - albedo f) t) F + sum of g_l J_k Y_k)                          (2)
///            + T' E)                                                                            (3)
///   (2) is the medium without its forward peak. (1) replaces the light that no peak scatters, which is known
///   exactly, by that with the whole phase function. What stands behind is seen through T'.
/// @source    [JWW76] (2); own (1): the textbook's form replaces single scattering by the exact one behind
///   the scaled transmittance, which errs by more than the light against the sun
/// @deviation light that meets the peak several times and nothing else has P' instead of a narrower peak
/// @valid     any
/// @accuracy  see docs/howto/illumination-network.md
/// @tests     tests/rendering/network/test_network_gather.cpp
struct GatherPoint
{
    double albedo = 0.0;     ///< [1]
    double lightDepth = 0.0; ///< [1] t
    double cosine = 0.0;     ///< [1] between the way of the light and the direction to the eye
    double irradiance = 0.0; ///< [lx] F
};

/// Two parts of the light per k ds: behind T and behind T'.
struct GatheredLight
{
    double plain = 0.0;  ///< [cd/m2] (1)
    double scaled = 0.0; ///< [cd/m2] (2) without the network's, or its
};

GatheredLight gatherUnscattered(const NetworkPhase& phase, const GatherPoint& point);
/// [cd/m2] (2), b times the sum. @param toEye unit, the way the light goes
double gatherScattered(const NetworkPhase& phase, double albedo, const NetworkState& state,
                       const glm::dvec3& position, const glm::dvec3& toEye);

} // namespace fx::render
