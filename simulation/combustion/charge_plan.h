/// @file charge_plan.h
/// Initial state of a charge of given energy, and the size and duration of its fireball.
///
/// @formula charge-plan
/// Mass, ball of gas at the start and fireball, all from the energy.
/// Mass, initial ball of gas and fireball, all computed from the energy.
/// symbol   unit      meaning
///   E       J         energy of the charge; W kg of TNT are 4.184e6 W
///   e       J/kg      nominal energy of the material
///   m       kg        mass
///   e_0     J/kg      heat at the start
///   r, T    J/(kg K), K  gas constant and temperature of the gas at the start
///   p       Pa        pressure at the start
///   V, R    m3, m     volume and radius of the ball
///   gamma   1         ratio of specific heats with which the ball contains exactly the heat e_0 m
///   D, t    m, s      diameter and duration of the fireball
/// @derivation
///   m = E / e                                                                          (1)
///   The products have expanded to the pressure p without doing work: V = m r T / p        (2)
///   p V / (gamma - 1) = e_0 m gives gamma = 1 + r T / e_0                              (3)
///   Without heat at the start, the ball has the pressure of the air and gamma of the air  (4)
///   D = k_D m^(1/3), t = k_t m^(1/3); above the mass of large clouds t = k_l m^(1/6)    (5)
///   Therefore every length and time of one material grows as E^(1/3) (Hopkinson scaling).
/// @source    [ROB81] [CCPS10] for (5); (2)-(4) are elementary (ideal gas)
/// @deviation (2) starts from a ball at moderate pressure instead of the solid charge. The work of the
///            products on the first air is not subtracted, so that the blast has the whole energy of the
///            charge
/// @valid     E > 0 and finite; anything else gives a plan of mass 0
/// @accuracy  p V / (gamma - 1) = e_0 m to 1e-14; scaling to 1e-14
/// @tests     tests/simulation/combustion/test_charge_plan.cpp
#pragma once

#include "simulation/combustion/materials.h"
#include "simulation/motion/ambient_air.h"

namespace fx::sim {

/// The air around a charge.
struct AmbientAir
{
    double temperature = kAirKelvin; ///< [K]
    double pressure = 101325.0;      ///< [Pa]
};

struct ChargePlan
{
    double mass = 0;        ///< [kg] mass of the material
    double radius = 0;      ///< [m] initial radius of the ball of gas
    double temperature = 0; ///< [K]
    double pressure = 0;    ///< [Pa]
    double density = 0;     ///< [kg/m3]
    double gamma = 0;       ///< [1]
    /// [m/s] initial speed of the ball's surface; inside of the ball, the speed is proportional to the
    /// distance from the center
    double rimSpeed = 0;
    double heat = 0;             ///< [J] initial heat relative to air at ambient temperature
    double fuel = 0;             ///< [J] heat that combustion will release
    double fireballDiameter = 0; ///< [m] expected diameter of the fireball
    double fireballDuration = 0; ///< [s] expected duration of the fireball
};

/// Computes the initial state of a charge.
/// @param energy [J] energy of the charge
/// @param pressureRatio [1] pressure of the ball divided by the pressure of the air, clamped to 1..1e4.
/// Ignored
///         if the material has no heat at the start
ChargePlan planCharge(const Material& material, double energy, double pressureRatio = 40.0,
                      const AmbientAir& air = {});

/// [J] Energy of a mass of TNT in kilograms.
constexpr double energyOfTnt(double kilograms)
{
    return kTntEquivalent * kilograms;
}

} // namespace fx::sim
