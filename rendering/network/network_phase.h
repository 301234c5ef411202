/// @file network_phase.h
/// A phase function with few moments and without negative values.
#pragma once

#include <algorithm>
#include <array>

namespace fx::render {

/// @formula network-phase
/// The phase function of Henyey and Greenstein, approximated by a forward peak and a short series.
///
/// symbol       unit   meaning
///   g            1      mean cosine
///   L            1      last band of the series: 1 with 4 moments, 2 with 9
///   f            1      forward peak: share of scattered light that keeps its direction
///   g_l          1      factor of band l of the remaining phase function
///   albedo', k'  1,1/m  albedo and extinction if light in the peak counts as not scattered
///   P            1/sr   the series, sum over l of (2 l + 1) / (4 pi) g_l P_l(c), c the cosine
/// @derivation
///   The moments of the phase function are g^l. Without the peak,
///       g_l = (g^l - f) / (1 - f)                                                               (1)
///       k' = k (1 - albedo f), albedo' = albedo (1 - f) / (1 - albedo f)                        (2)
///   f = g^(L+1) matches one more moment, but the series may then have negative values. For L = 1 it does if
///   g_1 > 1/3. For L = 2 its least value is 1 - 2.5 g_2 - 0.3 g_1^2 / g_2 at c = -g_1 / (5 g_2), or, if this
///   c is outside of -1..1, 1 - 3 g_1 + 5 g_2. f is the smallest value >= g^(L+1) for which the series has no
///   negative values                                                                             (3)
///   For L = 1 this is max(g^2, (3 g - 1) / 2)                                                   (4)
///   For L = 2 and g > 0.93 there is no such f. Then g_2 = 1/5, for which the largest allowed g_1 is
///   3^(-1/2); f follows from this g_1                                                           (5)
/// @source    [JWW76] (1) and (2)
/// @deviation (3) to (5) are own: light is never negative, and the mean cosine is kept
/// @valid     -0.3 <= g <= 0.98; other values are clamped to this range
/// @accuracy  (1 - f)(1 - g_1) = 1 - g within 1e-12; P >= -1e-9
/// @tests     tests/rendering/network/test_network_basis.cpp
struct NetworkPhase
{
    double anisotropy = 0.0;                      ///< [1] mean cosine g, clamped to its range
    double peak = 0.0;                            ///< [1] symbol f
    std::array<double, 3> factors{1.0, 0.0, 0.0}; ///< [1] symbols g_l
    int bands = 2;                                ///< number of bands, L + 1

    double extinctionShare(double albedo) const { return 1.0 - albedo * peak; } ///< [1] ratio k' / k
    double albedo(double albedo) const { return albedo * (1.0 - peak) / (1.0 - albedo * peak); }
    double series(double cosine) const; ///< [1/sr] symbol P
};

/// Returns a phase function with few moments that approximates the Henyey-Greenstein function.
/// @param anisotropy [1] mean cosine g
/// @param moments 4 or 9
NetworkPhase networkPhase(double anisotropy, int moments);

} // namespace fx::render
