/// @file gas_release.h
/// Initial state of the gas.
///
/// @formula gas-release
/// Fills a ball evenly with particles of the charge and gives them uneven outward velocities.
///
/// symbol   unit    meaning
///   R, U    m, m/s  radius of the ball, speed of the charge's rim (charge-plan)
///   N       1       particles
///   phi     1       1.2207..., the real solution of x^4 = x + 1
///   d       1       direction from the center
///   g       1       unevenness of the velocity in direction d, mean 0
///   L       1       lumpiness
/// @derivation
///   u_k = frac(1/2 + i phi^-k), k = 1..3, fill the unit cube evenly                                 (1)
///   r = u_1^(1/3), cos = 1 - 2 u_2, azimuth u_3 turns: maps the cube to the ball, uniformly in volume  (2)
///   six jets of random direction j and strength s in [-1, 1]: g = sum s max(d.j, 0)^4               (3)
///   position R r d (1 + L g / 4) displaced by `jitter` spacings at random, velocity U r d (1 + L g)  (4)
/// @source    [ROB18] Roberts, "The unreasonable effectiveness of quasirandom sequences", for (1)
/// @deviation none
/// @valid     N >= 1
/// @accuracy  float rounding
/// @tests     tests/simulation/test_gas_solver.cpp
#pragma once

#include "simulation/combustion/charge_plan.h"
#include "simulation/gas/gas_def.h"
#include "simulation/gas/gas_parcels.h"
#include "simulation/solver/solver.h"
#include "simulation/sph/dynamics/gas_dynamics.h"

#include <span>

namespace fx::sim {

/// Adds `particles` particles to `gas` and initializes the parcels of the particles. Fails in the same cases
/// as GasDynamics::add().
base::Status releaseGas(const GasDef& def, const ChargePlan& plan, const StepContext& context,
                        std::span<GasParticle> scratch, GasDynamics<float>& gas, GasParcels& parcels);

/// [m] Distance between neighboring particles in the initial ball of the plan.
double spacingOf(const ChargePlan& plan, uint32_t particles);

} // namespace fx::sim
