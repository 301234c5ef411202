/// @file network_phase.h
/// A phase function in few moments that is nowhere negative.
#pragma once

#include <algorithm>
#include <array>

namespace fx::render {

/// @formula network-phase
/// Henyey and Greenstein's phase function as a forward peak and a short series.
///
/// symbol       unit   meaning
///   g            1      mean cosine
///   L            1      last band of the series: 1 with 4 moments, 2 with 9
///   f            1      share of the scattering that goes straight on
///   g_l          1      factor of band l of what is left
///   albedo', k'  1,1/m  albedo and extinction of a medium in which the peak counts as not scattered
///   P            1/sr   the series, sum over l of (2 l + 1) / (4 pi) g_l P_l(c), c the cosine
/// @derivation
///   The moments of the phase function are g^l. With the peak taken out,
///       g_l = (g^l - f) / (1 - f)                                                               (1)
///       k' = k (1 - albedo f), albedo' = albedo (1 - f) / (1 - albedo f)                        (2)
///   f = g^(L+1) matches one more moment. The series then has negative values: for L = 1 where g_1 > 1/3,
///   for L = 2 where 1 - 2.5 g_2 - 0.3 g_1^2 / g_2 < 0, its value at c = -g_1 / (5 g_2), or
///   1 - 3 g_1 + 5 g_2 < 0 when that lies outside. f is the smallest share from g^(L+1) on with which
///   it has none                                                                                 (3)
///   For L = 1 that is max(g^2, (3 g - 1) / 2)                                                   (4)
///   For L = 2 and g above 0.93 there is none. There g_2 = 1/5, at which g_1 may be largest, 3^(-1/2), and
///   f follows from g_1                                                                          (5)
/// @source    [JWW76] (1) and (2)
/// @deviation (3) to (5) are own: light is nowhere negative, and the mean cosine stays what it is
/// @valid     -0.3 <= g <= 0.98; what lies outside counts as the nearest of these
/// @accuracy  (1 - f)(1 - g_1) = 1 - g within 1e-12; P >= -1e-9
/// @tests     tests/rendering/network/test_network_basis.cpp
struct NetworkPhase
{
    double anisotropy = 0.0;                      ///< [1] g, within its range
    double peak = 0.0;                            ///< [1] f
    std::array<double, 3> factors{1.0, 0.0, 0.0}; ///< [1] g_l
    int bands = 2;                                ///< L + 1

    double extinctionShare(double albedo) const { return 1.0 - albedo * peak; } ///< [1] k' over k
    double albedo(double albedo) const { return albedo * (1.0 - peak) / (1.0 - albedo * peak); }
    double series(double cosine) const; ///< [1/sr] P
};

/// @param moments 4 or 9
NetworkPhase networkPhase(double anisotropy, int moments);

} // namespace fx::render
