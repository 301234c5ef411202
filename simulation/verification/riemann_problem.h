/// @file riemann_problem.h
/// @formula riemann-problem
/// Exact flow of two half spaces of ideal gas that are in contact at x = 0 from t = 0 on.
///
/// symbol    unit    meaning
///   rho, u, p kg/m3, m/s, Pa  state; index L left, R right, K either side, * between the outer waves
///   c         m/s   speed of sound
///   gamma     1     adiabatic exponent, > 1
///   A, B      m3/kg, Pa  2 / ((gamma + 1) rho_K) and (gamma - 1) / (gamma + 1) p_K
///   s         m/s   x / t
/// @derivation
///   The velocity of the gas between the waves due to wave K, as a function of the pressure p there:
///       shock, p > p_K        f_K = (p - p_K) sqrt(A / (p + B))                                  (1)
///       rarefaction, p <= p_K f_K = 2 c_K / (gamma - 1) ((p / p_K)^((gamma - 1) / (2 gamma)) - 1)  (2)
///   Pressure and velocity are continuous at the contact, so p* solves
///       f_L(p) + f_R(p) + u_R - u_L = 0,  u* = (u_L + u_R + f_R - f_L) / 2                       (3)
///   whose left side is monotone in p. Behind a shock, then behind a rarefaction,
///       rho* = rho_K (p*/p_K + k) / (k p*/p_K + 1), k = (gamma - 1) / (gamma + 1)                (4)
///       rho* = rho_K (p*/p_K)^(1/gamma)                                                          (5)
///   A shock moves at
///       S = u_K -+ c_K sqrt((gamma + 1) / (2 gamma) p*/p_K + (gamma - 1) / (2 gamma))            (6)
///   and inside a rarefaction, on the left
///       u = 2 / (gamma + 1) (c_L + (gamma - 1) / 2 u_L + s),  c = c_L + (gamma - 1) / 2 (u_L - u)  (7)
/// @source    [TOR09] Toro, chapter 4, doi:10.1007/b79761
/// @deviation p* is found by bisection of its logarithm instead of Newton's method, which needs no case
///            distinction; speed does not matter here
/// @valid     positive densities and pressures without a vacuum: u_R - u_L < 2 (c_L + c_R) / (gamma - 1)
/// @accuracy  p* to a relative error of 1e-14
/// @tests     tests/simulation/verification/test_riemann_problem.cpp
#pragma once

#include "simulation/verification/flow_state.h"

namespace fx::sim {

class RiemannProblem
{
public:
    RiemannProblem(const FlowState& left, const FlowState& right, double gamma);

    /// State on the ray x / t = speed.
    /// @param speed [m/s] x / t
    FlowState at(double speed) const;

    double starPressure() const { return pressure_; } ///< [Pa] pressure between the outer waves
    double starVelocity() const { return velocity_; } ///< [m/s]
    double starDensityLeft() const;                   ///< [kg/m3] density left of the contact
    double starDensityRight() const;                  ///< [kg/m3] density right of the contact
    /// [m/s] speed of the right shock, or of the head of the right rarefaction
    double rightWaveSpeed() const;

private:
    double velocityJump(const FlowState& side, double pressure) const;
    double starDensity(const FlowState& side) const;
    FlowState leftOfContact(const FlowState& left, double velocity, double speed) const;

    FlowState left_;
    FlowState right_;
    double gamma_;
    double pressure_ = 0;
    double velocity_ = 0;
};

} // namespace fx::sim
