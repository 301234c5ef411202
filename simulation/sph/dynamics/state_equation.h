/// @file state_equation.h
/// Equations of state of gases and fluids.
///
/// @formula state-equation
/// Pressure and internal energy in entropy form: the sum of a cold curve and a term that depends on entropy.
///
/// symbol   unit           meaning
///   rho     kg/m3          density, > 0
///   K       Pa (m3/kg)^g   entropy function, >= 0: constant while no heat is added
///   g       1              adiabatic exponent, > 1
///   Pc, uc  Pa, J/kg       cold curve
///   P       Pa             pressure
///   u       J/kg           specific internal energy
///   c       m/s            speed of sound
///   V       1              rho0 / rho
/// @derivation
///   P = Pc + K rho^g,  u = uc + K rho^(g-1) / (g - 1),  uc' = Pc / rho^2                        (1)
///   so that du = P / rho^2 drho at constant K (first law), and by differentiating (1)
///   c^2 = dP/drho at constant K = Pc' + g K rho^(g-1)                                            (2)
///   heat q per mass at constant density: dK = (g - 1) rho^(1-g) q, exact for any q               (3)
///   Stiffened gas: Pc = -Pinf, uc = Pinf / rho                                                   (4)
///   JWL, g = 1 + omega: Pc = A e^(-R1 V) + B e^(-R2 V),
///   uc = (A/R1 e^(-R1 V) + B/R2 e^(-R2 V)) / rho0,  Pc' = (A R1 e^(-R1 V) + B R2 e^(-R2 V)) V / rho  (5)
/// @source    [PRI12] section 2 for the entropy form; (4) and (5) are the usual equations of Le Metayer's and
///            Lee's, written with the isentrope of the ideal part
/// @deviation none
/// @valid     rho in [1e-30, 1e30]; c^2 below 0 (none for the documented ranges) counts as 0
/// @accuracy  relative error <= 1e-13 against numerical integration of du = P / rho^2 drho
/// @tests     tests/simulation/dynamics/test_state_equation.cpp
#pragma once

namespace fx::sim {

/// Equation of state. The ideal gas uses only gamma. The stiffened gas uses gamma and stiffness. JWL uses
/// gamma = 1 + omega, the four JWL constants and the reference density.
struct StateEquation
{
    double gamma = 1.4;          ///< [1] > 1
    double stiffness = 0;        ///< [Pa] P_inf >= 0
    double jwlA = 0;             ///< [Pa]
    double jwlB = 0;             ///< [Pa]
    double jwlR1 = 0;            ///< [1]
    double jwlR2 = 0;            ///< [1]
    double referenceDensity = 1; ///< [kg/m3] density rho_0 of the JWL curve
};

/// Quantities of a gas at one density and entropy.
struct StatePoint
{
    double pressure;      ///< [Pa]
    double energy;        ///< [J/kg] internal energy, including the cold curve
    double thermal;       ///< [J/kg] thermal part of the internal energy
    double sound;         ///< [m/s]
    double heatToEntropy; ///< factor that converts heat per mass to an increase of the entropy function K
};

/// The state at density `rho` and entropy function `entropy`.
StatePoint stateAt(const StateEquation& equation, double rho, double entropy);

/// Entropy function K at density `rho` and internal energy `energy`; 0 if the energy is below the cold curve.
double entropyOf(const StateEquation& equation, double rho, double energy);

} // namespace fx::sim
