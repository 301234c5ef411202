/// @file network_gather.h
/// Computes the light that a medium scatters and emits to an eye, from the light in the cells of an
/// illumination network.
#pragma once

#include "rendering/network/network_phase.h"
#include "rendering/network/network_state.h"

namespace fx::render {

/// @formula network-gather
/// Light along a ray of the eye through a medium, after the iteration of its network has converged.
///
/// symbol     unit   meaning
///   k, s     1/m, m extinction; length along the ray
///   T, T'    1      transmittance to the eye with k, and with k' = k (1 - albedo f)
///   f, g_l   1      of network-phase; b = albedo (1 - f)
///   P, H_N   1/sr   the series of network-phase; Henyey and Greenstein's function with g^N
///   t, X     1      optical depth from the light to the point; t plus that from the point to the eye
///   F        lx     illuminance of the light without the medium
///   J_k, Y_k        moments of the network's cells, harmonics of the direction to the eye
///   E        cd/m2  emission per optical depth
/// @derivation
///   dL = k ds (T' (b P exp(-(1 - albedo f) t) F + b sum of g_l J_k Y_k + E)                     (1)
///            + T exp(-t) F / X sum over N from 1 on of (albedo X)^N / N! R_N)                   (2)
///   (1) is the medium with its forward peak removed. It is exact in the bands of the series. The higher
///   bands come from light that is scattered N times through small angles and travels nearly straight. After
///   N scatterings, band l of the phase function is g^(l N). In (1) it is h_l^N with h_l = f + (1 - f) g_l,
///   and the peak contributes f^N to each band:
///       R_N = H_N - sum over l of (2 l + 1) / (4 pi) (h_l^N - f^N) P_l(c)                       (3)
///   N scatterings on a path of depth X have the weight X^N / N!. With one of them at the point, it is
///   X^(N-1) / (N-1)!. Any of the N may be the one at the point, so (2) has the N-th part of it. The term
///   N = 1 makes single scattering exact. Terms with N > 16 are omitted                          (4)
///   (2) can be negative; it is limited so that its sum with the first part of (1) is not        (5)
///   The background is attenuated by T'.
/// @source    [JWW76] (1); [VDH80] small angles; the rest is own
/// @deviation (4), (5)
/// @valid     any
/// @accuracy  see docs/howto/illumination-network.md
/// @tests     tests/rendering/network/test_network_gather.cpp
struct GatherPoint
{
    double albedo = 0.0;     ///< [1]
    double lightDepth = 0.0; ///< [1] symbol t: optical depth between light and point
    double eyeDepth = 0.0;   ///< [1] optical depth between point and eye
    /// [1] cosine of the scattering angle from the light to the eye
    double cosine = 0.0;
    double irradiance = 0.0; ///< [lx] symbol F
};

/// Two parts of the scattered light per optical depth k ds, see formula network-gather. The transmittance T
/// attenuates `plain`, and T' attenuates `scaled`.
struct GatheredLight
{
    double plain = 0.0;  ///< [cd/m2] equation (2)
    double scaled = 0.0; ///< [cd/m2] first part of equation (1)
};

GatheredLight gatherUnscattered(const NetworkPhase& phase, const GatherPoint& point);
/// [cd/m2] Second part of equation (1).
/// @param toEye unit vector from the point to the eye
double gatherScattered(const NetworkPhase& phase, double albedo, const NetworkState& state,
                       const glm::dvec3& position, const glm::dvec3& toEye);

} // namespace fx::render
