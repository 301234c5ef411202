/// @file gas_release.h
/// The gas at the moment it is let go.
///
/// @formula gas-release
/// Fills a ball evenly with particles of compressed hot gas.
///
/// symbol   unit    meaning
///   R       m       radius of the ball
///   N       1       particles
///   S       1       pressure over the air's
///   rho     kg/m3   density of the gas
///   phi     1       1.2207..., the real solution of x^4 = x + 1
/// @derivation
///   Ideal gas at pressure S p_air: rho = S rho_air T_air / T, so each particle has m = rho (4/3 pi R^3) / N
///   (1) u_k = frac(1/2 + i phi^-k), k = 1..3, fill the unit cube evenly (2) r = R u_1^(1/3), cos = 1 - 2
///   u_2, azimuth u_3 turns: the cube's volume becomes the ball's                   (3) displaced by `jitter`
///   spacings R (4/3 pi / N)^(1/3) at random                                               (4)
/// @source    [ROB18] Roberts, "The unreasonable effectiveness of quasirandom sequences", for (2)
/// @deviation none
/// @valid     N >= 1; spacings below 1 mm count as 1 mm, in mass and smoothing length
/// @accuracy  float rounding
/// @tests     tests/simulation/test_gas_solver.cpp
#pragma once

#include "simulation/solver.h"
#include "simulation/sph/gas_def.h"
#include "simulation/sph/gas_store.h"

namespace fx::sim {

/// Sets every column of `gas`. The host's intensity scales the excess pressure.
void releaseGas(const GasDef& def, const StepContext& context, GasStore& gas);

/// [m] smoothing length at the moment of release, before the host's intensity.
float releaseSmoothing(const GasDef& def);

} // namespace fx::sim
