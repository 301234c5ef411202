/// @file shear_layer.h
/// @formula shear-layer-growth
/// Growth rate of a small wave on the sharp boundary between two streams of different speed
/// (Kelvin-Helmholtz).
///
/// symbol       unit   meaning
///   k           1/m    wave number along the streams
///   rho1, rho2  kg/m3  densities
///   U1, U2      m/s    speeds along the wave
///   c1, c2      m/s    speeds of sound
///   w           1/s    complex frequency of exp(i (k x - w t)); growth is its imaginary part
///   W_a         1/s    w - k U_a, frequency in the frame of a stream
///   q_a         1/m    decay away from the boundary
/// @derivation
///   In each stream the pressure obeys the wave equation, so it decays as exp(-q_a |y|) with
///       q_a = sqrt(k^2 - W_a^2 / c_a^2)                                                         (1)
///   The displacement and the pressure are continuous across the boundary:
///       rho1 W_1^2 / q_1 + rho2 W_2^2 / q_2 = 0                                                  (2)
///   For c -> infinity, q = k, and the growing root is
///       Im w = k |U1 - U2| sqrt(rho1 rho2) / (rho1 + rho2)                                        (3)
/// @source    [LL87] Landau, Lifshitz: Fluid Mechanics, sections 62 and 84
/// @deviation none
/// @valid     streams much thicker than 1/k; without gravity and viscosity. (2) is solved by Newton's method
///            from (3), for velocity differences well below c1 + c2
/// @accuracy  (3) rounding, (2) to 1e-12
/// @tests     tests/simulation/verification/test_shear_layer.cpp
#pragma once

namespace fx::sim {

struct ShearLayer
{
    double wavenumber;         ///< [1/m]
    double density1, density2; ///< [kg/m3]
    double speed1, speed2;     ///< [m/s]
    double sound1, sound2;     ///< [m/s]

    double incompressibleGrowth() const; ///< [1/s]
    double growth() const;               ///< [1/s] growth rate with compressibility
};

} // namespace fx::sim
