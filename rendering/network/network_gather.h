/// @file network_gather.h
/// Computes the light that a medium scatters and emits to an eye, from the light in the cells of an
/// illumination network.
#pragma once

#include "rendering/network/network_basis.h"
#include "rendering/network/network_phase.h"
#include "rendering/network/network_state.h"

#include <array>
#include <vector>

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
///
/// What a phase function does at one angle. Immutable after construction. Threads: any.
class GatherAngle
{
public:
    static constexpr int kMaxOrder = 16; ///< largest N of (2)

    /// @param cosine [1] of the scattering angle from the light to the eye
    GatherAngle(const NetworkPhase& phase, double cosine);

    double series() const { return series_; } ///< [1/sr] symbol P, >= 0
    double peak() const { return peak_; }     ///< [1] symbol f
    int orders() const { return orders_; }    ///< number of orders of (2) with light
    /// [1/sr] Sum of (2) over X, without F and transmittances. @param depth [1] symbol X
    double smallAngles(double albedo, double depth) const;

private:
    double series_ = 0.0, peak_ = 0.0;
    int orders_ = 0;
    std::array<double, kMaxOrder> rest_{}; ///< [1/sr] R_N / N!
};

/// A point in the medium, and a light.
struct GatherPoint
{
    double albedo = 0.0;     ///< [1]
    double lightDepth = 0.0; ///< [1] symbol t: optical depth between light and point
    double eyeDepth = 0.0;   ///< [1] optical depth between point and eye
    double irradiance = 0.0; ///< [lx] symbol F
};

/// Two parts of the scattered light per optical depth k ds, see formula network-gather. The transmittance T
/// attenuates `plain`, and T' attenuates `scaled`.
struct GatheredLight
{
    double plain = 0.0;  ///< [cd/m2] equation (2)
    double scaled = 0.0; ///< [cd/m2] first part of equation (1)
};

/// @param angle the same for all points of a ray if the light is parallel
GatheredLight gatherUnscattered(const GatherAngle& angle, const GatherPoint& point);

/// Second part of equation (1) for any number of rays: the moments of a network, those of a cell one after
/// another. Immutable after construction. Threads: any.
class GatherMoments
{
public:
    /// Factors of the moments for one direction to the eye.
    using Weights = std::array<float, 12>;

    GatherMoments(const NetworkPhase& phase, const NetworkState& state);

    /// @param toEye unit vector from the medium to the eye
    Weights weights(const glm::dvec3& toEye) const;
    /// [cd/m2] Scattered light per optical depth, >= 0, for an albedo of 1: the albedo multiplies it.
    double at(const glm::dvec3& position, const Weights& weights) const;

private:
    template <int Stride>
    double sum(const glm::dvec3& position, const Weights& weights) const;

    NetworkGrid grid_;
    std::array<double, kMaxNetworkMoments> factors_{}; ///< [1] (1 - f) g_l of each moment
    int moments_ = 0, stride_ = 4;                     ///< stride: of cells in light_, 4 or 12
    std::vector<float> light_;                         ///< [cd/m2 sr]
};

} // namespace fx::render
