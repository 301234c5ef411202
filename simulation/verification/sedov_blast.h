/// @file sedov_blast.h
/// @formula sedov-blast
/// Energy released at a point of a cold, uniform ideal gas: the self-similar flow behind a strong shock.
///
/// symbol      unit     meaning
///   E          J        energy
///   rho0       kg/m3    density of the gas at rest
///   gamma      1        adiabatic exponent
///   R, x       m, 1     radius of the shock, x = r / R
///   xi0        1        dimensionless constant of R
///   V, G, Z    1        velocity, density and squared speed of sound without dimension
/// @derivation
///   The only length that can be formed from E, rho0 and t is
///       R = xi0 (E t^2 / rho0)^(1/5), shock speed U = 2 R / (5 t)                                (1)
///   With v = 2 r / (5 t) V, rho = rho0 G, c^2 = (2 r / (5 t))^2 Z the energy within x is constant, so that
///       Z = gamma (gamma - 1) (1 - V) V^2 / (2 (gamma V - 1))                                    (2)
///   and the equations of motion integrate to, with a = (gamma + 1) / (gamma - 1) (gamma V - 1),
///   b = (gamma + 1) / (7 - gamma) (5 - (3 gamma - 1) V), d = (gamma + 1) / (gamma - 1) (1 - V),
///       x^5 = ((gamma + 1) V / 2)^-2 b^n1 a^n2                                                   (3)
///       G = (gamma + 1) / (gamma - 1) a^n3 b^n4 d^n5                                             (4)
///       n1 = -(13 gamma^2 - 7 gamma + 12) / ((3 gamma - 1) (2 gamma + 1)), n2 = 5 (gamma - 1) / (2 gamma +
///       1), n3 = 3 / (2 gamma + 1), n4 = -n1 / (2 - gamma), n5 = -2 / (2 - gamma)
///   a increases from 0 at the center to 1 behind the shock, and x increases with a. The energy determines
///   xi0:
///       xi0^5 16 pi / 25 integral_0^1 G (V^2 / 2 + Z / (gamma (gamma - 1))) x^4 dx = 1           (5)
///   Near the center G is proportional to x^(3 / (gamma - 1)), and the pressure is constant      (6)
/// @source    [LL87] Landau, Lifshitz: Fluid Mechanics, section 106; [KT07] Kamm, Timmes, for values
/// @deviation (3) is solved at 4096 equidistant x; between them the state is interpolated linearly. Below the
///            first x, density and pressure follow (6)
/// @valid     1 < gamma < 7, gamma != 2; ambient pressure negligible
/// @accuracy  xi0 to 1e-6, states to 1e-5 behind the shock
/// @tests     tests/simulation/verification/test_sedov_blast.cpp
#pragma once

#include "simulation/verification/flow_state.h"

#include <vector>

namespace fx::sim {

class SedovBlast
{
public:
    /// Computes the similarity solution.
    /// @param energy [J] energy of the blast
    /// @param density [kg/m3] density of the gas at rest
    SedovBlast(double gamma, double energy, double density);

    double xi0() const { return xi0_; }
    double shockRadius(double time) const; ///< [m]
    double shockSpeed(double time) const;  ///< [m/s]
    /// State immediately behind the shock.
    FlowState behindShock(double time) const;
    /// State at a radius and time. Ahead of the shock, the gas is at rest and its pressure is 0.
    FlowState at(double radius, double time) const;

private:
    struct Similar
    {
        double velocity; ///< V x, the velocity in units of the shock speed
        double density;  ///< density G without dimension
        double pressure; ///< G Z x^2 / gamma, the pressure in units of rho0 U^2
    };
    double gamma_;
    double energy_;
    double density_;
    double xi0_ = 0;
    std::vector<Similar> table_; ///< solution at the points x = k / (size - 1)
};

} // namespace fx::sim
