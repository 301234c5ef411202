/// @file fire_parcel.h
/// One parcel of gas that ignites, burns, radiates and mixes with air. The mixing rate limits the burning. A
/// step has a closed form.
///
/// @formula three-gases
/// Mass fractions of unburnt, burning and burnt gas after a step of any length, and the released heat.
///
/// symbol   unit   meaning
///   Y_u, Y_g, Y_b  1      unburnt, burning, burnt; fractions of the parcel's own mass m, their sum is 1
///   k_i     1/s    ignition rate: 1 / delay above 1.2 ignition temperatures, 0 below one, smooth between
///   k_b     1/s    burn rate: 1 / burn time
///   q       1/s    entrainment rate: air mass per mass of the parcel
///   M       1      mass of parcel and air over m
///   s       1      air mass needed per unit of own mass
///   o       1      share that burns without air
///   h       J/kg   heat of combustion
///   t       s      length of the step
/// @derivation
///   dY_u/dt = -k_i Y_u, dY_g/dt = k_i Y_u - k_b Y_g have the solution
///       Y_u <- Y_u exp(-k_i t)                                                                 (1)
///       Y_g <- Y_g exp(-k_b t) + k_i Y_u (exp(-k_i t) - exp(-k_b t)) / (k_b - k_i)             (2)
///   the quotient is t exp(-k t) (1 - exp(-x)) / x, with the smaller rate k, x = |k_b - k_i| t  (3)
///   Air grows as M <- M exp(q t) (4), and it limits the burnt fraction: Y_b <= o + (M - 1) / s (5)
///   Gas that cannot burn for lack of air remains burning gas: Y_g <- 1 - Y_u - Y_b             (6)
///   The heat m h (Y_b' - Y_b) stays in the parcel. Therefore, with the heat capacity c,
///       m c M (T - T_a) <- m c M (T - T_a) + m h (Y_b' - Y_b)                                  (7)
///   includes cooling by entrained air and heating by combustion in one exact balance.
/// @source    own model; (1)-(3) are elementary (Bateman's equations of a chain)
/// @deviation burning gas does not go out, however cold it becomes; one heat capacity for gas and air
/// @valid     rates >= 0, t from 0 to 1e9 s; t <= 0 and NaN change nothing
/// @accuracy  Y_u + Y_g + Y_b = 1 exactly; 1000 steps of 1 ms equal one step of 1 s to 1e-12 while either the
///            reaction chain or the air limits the burning; first order in a step in which the limit changes
/// @tests     tests/simulation/combustion/test_fire_parcel.cpp
///
/// @formula parcel-radiation
/// Radiative loss of a gray ball, exact over the step.
///
/// symbol   unit   meaning
///   T, T_a  K      temperature of the parcel, of the air
///   R       m      radius
///   S       m2     absorption cross section of the soot in the parcel
///   e       1      emissivity
///   X       1      share of the surface that is exposed to the outside
///   C       J/K    heat capacity of parcel and air, m c M
/// @derivation
///   mean path through a ball 4 R / 3 at absorption S / (4/3 pi R^3) gives e = 1 - exp(-S / (pi R^2))   (8)
///   C dT/dt = -e 4 pi R^2 X sigma T^4 has the solution
///       T <- T (1 + 3 r t T^3)^(-1/3), r = 4 pi R^2 e X sigma / C                                      (9)
///   T does not fall below T_a (10). Half of the radiation is applied before the three gases and half
///   afterwards, with the soot of that moment (Strang splitting).
/// @source    elementary (Stefan-Boltzmann law; mean chord of a ball)
/// @deviation radiation of the air onto the gas is replaced by the lower bound T_a
/// @valid     R > 0; T from 0 to 1e5 K
/// @accuracy  pure radiation: any division of the step agrees to 1e-12
/// @tests     tests/simulation/combustion/test_fire_parcel.cpp
#pragma once

#include "simulation/combustion/materials.h"
#include "simulation/motion/ambient_air.h"

namespace fx::sim {

/// One parcel. Fractions are relative to `ownMass`, the mass of material. `mixing` includes the entrained
/// air.
struct FireParcel
{
    double ownMass = 1;              ///< [kg] > 0
    double unburnt = 0;              ///< [1]
    double burning = 0;              ///< [1]
    double burnt = 1;                ///< [1]
    double mixing = 1;               ///< [1] mass of the parcel including air, divided by ownMass; >= 1
    double temperature = kAirKelvin; ///< [K]
};

/// Surroundings of a parcel during a step.
struct FireSurroundings
{
    double airTemperature = kAirKelvin; ///< [K]
    /// [K] temperature of flames that touch the parcel. Ignition uses the higher one of the flames' and the
    /// parcel's temperature.
    double hottest = 0;
    double entrainment = 0; ///< [1/s] entrainment rate q
    double radius = 1;      ///< [m]
    double exposure = 1;    ///< [1] share X of the surface that is exposed to the outside
};

/// Energy balance, summed over calls.
struct FireLedger
{
    double released = 0;   ///< [J] heat released by combustion
    double radiated = 0;   ///< [J]
    double givenToAir = 0; ///< [J] heat lost with the air beyond the largest mixing
};

constexpr double kMaxMixing = 1e6; ///< [1] largest mixing; above it, a parcel is treated as air

/// Initial parcel of `mass` kilograms of material.
FireParcel startParcel(const Material& material, double mass);

/// The parcel after `seconds` [s].
FireParcel burnParcel(const Material& material, const FireParcel& parcel, const FireSurroundings& around,
                      double seconds, FireLedger& ioLedger);

/// [J] Heat of the parcel relative to air of `airTemperature` [K].
double heatOf(const Material& material, const FireParcel& parcel, double airTemperature);

/// [1/s] Ignition rate k_i at a temperature.
double ignitionRate(const Material& material, double temperature);

/// [1/s] Rate at which a ball of `radius` [m] entrains air while it moves at `speed` [m/s] relative to the
/// air. `density` is the density of the ball divided by the density of the air. The rate is q = 3 alpha speed
/// / (radius density), with the entrainment constant alpha = 0.25 of thermals [MTT56].
double entrainmentRate(double speed, double radius, double density);

} // namespace fx::sim
