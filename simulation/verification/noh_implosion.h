/// @file noh_implosion.h
/// @formula noh-implosion Cold gas that flows towards a center from all directions with the same speed, and
/// comes to rest behind a shock.
///
/// symbol     unit    meaning
///   rho0      kg/m3   density at t = 0
///   v0        m/s     inward speed, > 0
///   gamma     1       adiabatic exponent
///   r, t      m, s    distance from the center, time
///   S         m/s     speed of the shock
/// @derivation
///   Without pressure the gas keeps its speed. A shell of radius r + v0 t at the start has shrunk to r, so
///   ahead of the shock
///       rho = rho0 (1 + v0 t / r)^2                                                             (1)
///   Behind the shock the gas is at rest. Conservation of mass and energy across a strong shock gives
///       S = (gamma - 1) v0 / 2,  rho2 / rho1 = (gamma + 1) / (gamma - 1)                         (2)
///   (1) at r = S t is the square of the same factor, so
///       rho2 = rho0 ((gamma + 1) / (gamma - 1))^3,  p2 = (gamma - 1) rho2 v0^2 / 2              (3)
/// @source    [NOH87] Noh, section 4, doi:10.1016/0021-9991(87)90074-X
/// @deviation none
/// @valid     t > 0, r > 0, ambient pressure negligible
/// @accuracy  rounding
/// @tests     tests/simulation/verification/test_noh_implosion.cpp
#pragma once

#include "simulation/verification/flow_state.h"

namespace fx::sim {

struct NohImplosion
{
    double gamma = 5.0 / 3.0;
    double density = 1; ///< [kg/m3] initial density rho0
    double speed = 1;   ///< [m/s] inward speed v0, > 0

    double shockSpeed() const { return 0.5 * (gamma - 1) * speed; } // (2)

    FlowState at(double radius, double time) const
    {
        const double ratio = (gamma + 1) / (gamma - 1);
        if (radius < shockSpeed() * time) {
            const double dense = density * ratio * ratio * ratio;         // (3)
            return {dense, 0, (gamma - 1) * dense * 0.5 * speed * speed}; // (3)
        }
        const double shrink = 1 + speed * time / radius;
        return {density * shrink * shrink, -speed, 0}; // (1)
    }
};

} // namespace fx::sim
