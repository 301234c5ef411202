/// @file fire_parcel.h
/// One parcel of gas that ignites, burns as fast as air reaches it, radiates and mixes: three gases in closed
/// form.
///
/// @formula three-gases
/// Mass fractions of unburnt, burning and burnt gas after a step of any length, and the heat that is
/// released.
///
/// symbol   unit   meaning
///   Y_u, Y_g, Y_b  1      unburnt, burning, burnt; fractions of the parcel's own mass m, their sum is 1
///   k_i     1/s    ignition rate: 1 / delay above 1.2 ignition temperatures, 0 below one, smooth between
///   k_b     1/s    burn rate: 1 / burn time
///   q       1/s    entrainment: air taken in, per mass of the parcel
///   M       1      mass of parcel and air over m
///   s       1      air needed by a unit of own mass
///   o       1      share that burns without air
///   h       J/kg   heat of combustion
///   t       s      length of the step
/// @derivation
///   dY_u/dt = -k_i Y_u, dY_g/dt = k_i Y_u - k_b Y_g have the solution
///       Y_u <- Y_u exp(-k_i t)                                                                 (1)
///       Y_g <- Y_g exp(-k_b t) + k_i Y_u (exp(-k_i t) - exp(-k_b t)) / (k_b - k_i)             (2)
///   the quotient is t exp(-k t) (1 - exp(-x)) / x, k the smaller rate, x = |k_b - k_i| t       (3)
///   Air grows as M <- M exp(q t) (4), and no more burns than it allows: Y_b <= o + (M - 1) / s (5)
///   what cannot burn for lack of air stays burning gas: Y_g <- 1 - Y_u - Y_b                   (6)
///   Heat m h times the growth of Y_b stays in the parcel; so, with c the heat capacity,
///       m c M (T - T_a) <- m c M (T - T_a) + m h (Y_b' - Y_b)                                  (7)
///   which cools by entrained air and heats by combustion in one exact balance.
/// @source    own model; (1)-(3) are elementary (Bateman's equations of a chain)
/// @deviation once alight, gas stays alight however cold it gets; one heat capacity for gas and air
/// @valid     rates >= 0, t from 0 to 1e9 s; t <= 0 and NaN change nothing
/// @accuracy  Y_u + Y_g + Y_b = 1 exactly; 1000 steps of 1 ms equal one of 1 s to 1e-12 while either the
/// chain or the
///            air decides; first order in the step where one takes over from the other
/// @tests     tests/simulation/combustion/test_fire_parcel.cpp
///
/// @formula parcel-radiation
/// Loss of a gray ball by radiation, exact over the step.
///
/// symbol   unit   meaning
///   T, T_a  K      temperature of the parcel, of the air
///   R       m      radius
///   S       m2     absorption cross section of the soot in the parcel
///   e       1      emissivity
///   X       1      share of the surface that sees the outside
///   C       J/K    heat capacity of parcel and air, m c M
/// @derivation
///   mean path through a ball 4 R / 3 at absorption S / (4/3 pi R^3) gives e = 1 - exp(-S / (pi R^2))   (8)
///   C dT/dt = -e 4 pi R^2 X sigma T^4 has the solution T <- T (1 + 3 r t T^3)^(-1/3), r = 4 pi R^2 e X sigma
///   / C (9) not below T_a (10). Half of it before the three gases, half after, with the soot of either
///   moment (Strang).
/// @source    elementary (Stefan-Boltzmann law; mean chord of a ball)
/// @deviation radiation of the air back onto the gas is left out, and the floor T_a put in its place
/// @valid     R > 0; T from 0 to 1e5 K
/// @accuracy  pure radiation: any cutting of the step agrees to 1e-12
/// @tests     tests/simulation/combustion/test_fire_parcel.cpp
#pragma once

#include "simulation/combustion/materials.h"
#include "simulation/motion/ambient_air.h"

namespace fx::sim {

/// One parcel. Fractions refer to `ownMass`, the mass of material; air taken in is counted by `mixing`.
struct FireParcel
{
    double ownMass = 1;              ///< [kg] > 0
    double unburnt = 0;              ///< [1]
    double burning = 0;              ///< [1]
    double burnt = 1;                ///< [1]
    double mixing = 1;               ///< [1] >= 1, mass with air over ownMass
    double temperature = kAirKelvin; ///< [K]
};

/// Surroundings of a parcel during a step.
struct FireSurroundings
{
    double airTemperature = kAirKelvin; ///< [K]
    double hottest = 0;     ///< [K] of the flames that touch the parcel; ignition takes the hotter of both
    double entrainment = 0; ///< [1/s] q
    double radius = 1;      ///< [m]
    double exposure = 1;    ///< [1] X
};

/// Where energy went, summed over calls.
struct FireLedger
{
    double released = 0;   ///< [J] by combustion
    double radiated = 0;   ///< [J]
    double givenToAir = 0; ///< [J] left with air beyond the largest mixing
};

constexpr double kMaxMixing = 1e6; ///< [1] parcels of higher mixing count as air

/// A parcel of `mass` kilograms of material as the effect begins.
FireParcel startParcel(const Material& material, double mass);

/// The parcel after `seconds`.
FireParcel burnParcel(const Material& material, const FireParcel& parcel, const FireSurroundings& around,
                      double seconds, FireLedger& ioLedger);

/// [J] of the parcel above air of that temperature.
double heatOf(const Material& material, const FireParcel& parcel, double airTemperature);

/// [1/s] (k_i) at that temperature.
double ignitionRate(const Material& material, double temperature);

/// [1/s] air drawn into a ball of `radius` [m] that moves at `speed` [m/s] against the air, `density` its
/// share of the air's: q = 3 alpha speed / (radius density), alpha = 0.25 of thermals [MTT56].
double entrainmentRate(double speed, double radius, double density);

} // namespace fx::sim
