/// @file gas_optics.h
/// How hot gas cools, how its soot forms, and how the smoke dissolves.
///
/// @formula gas-cooling
/// Mixing and radiation, each solved exactly over a step.
///
/// symbol   unit   meaning
///   T, T_a  K      temperature of the parcel, of the air
///   T_0     K      temperature at release
///   t       s      length of the step
///   q       1/s    mixing rate of this particle
///   r       1/s    radiation rate at T_0 of this particle
///   M       1      mass of the parcel over its own gas
///   s       1      soot formed
///   p       1      presence: what has not dissolved
///   d       1/s    dissipation
/// @derivation
///   Taking in air at the rate q: dM/dt = q M and d(T - T_a)/dt = -q (T - T_a), heat M (T - T_a) kept, so
///       T <- T_a + (T - T_a) exp(-q t),  M <- M exp(q t)                                          (1)
///   Radiating as T^4: d(T/T_0)/dt = -r (T/T_0)^4, so
///       T <- T (1 + 3 r t (T/T_0)^3)^(-1/3), not below T_a                                        (2)
///   Both faster where the parcel is exposed: times (2/5 + 6/5 e) and its own factor (vigor)       (3)
///   Soot, once formed, stays: s <- max(s, 1 - smoothstep(T_s, 1.6 T_s, T))                        (4)
///   Cold smoke thins: p <- p exp(-d s t)                                                          (5)
/// @source    elementary (ordinary differential equations in closed form); (3)-(5) are ours
/// @deviation radiation of the air back onto the gas is left out, and the floor T_a put in its place
/// @valid     T >= T_a; rates >= 0; exponents beyond 40 in M are limited
/// @accuracy  float rounding for any step length
/// @tests     tests/simulation/test_gas_optics.cpp
#pragma once

#include "simulation/sph/gas_def.h"
#include "simulation/sph/gas_store.h"

namespace fx::sim {

/// Presence below which smoke is no longer drawn; what is drawn fades to nothing as it gets there.
constexpr float kFaintest = 0.02f;

/// Temperature and mixing of one parcel.
struct Parcel
{
    float temperature; ///< [K]
    float mixing;      ///< [1]
};

/// (1) and (2). Rates in 1/s, `initial` is T_0.
Parcel coolParcel(const Parcel& parcel, float mixingRate, float radiationRate, float initial, float seconds);

/// (1)-(5) for the particles [begin, end).
void coolGas(const GasDef& def, GasStore& gas, float seconds, uint32_t begin, uint32_t end);

/// [1] part of a parcel's medium that glows: 1 when hot, 0 when its soot no longer burns.
float fireShareOf(const GasDef& def, float temperature);

} // namespace fx::sim
