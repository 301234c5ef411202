/// @file gas_forces.h
/// Pressure and viscosity between gas particles.
///
/// @formula gas-forces
/// Hot gas of reduced sound speed pushes its neighbors away until it is in pressure balance with the air.
///
/// symbol   unit    meaning
///   rho     kg/m3   density of the gas's own mass
///   rho_e   kg/m3   the same at pressure balance with the air
///   rho_a   kg/m3   density of the air
///   T, T_a  K       temperature of gas and air
///   M       1       mass of the parcel with the air it has mixed in, over its own
///   c       m/s     reduced speed of sound
///   P       Pa      excess pressure
///   x, v            x_i - x_j, v_i - v_j
///   g       1/m5    kernel gradient factor, see wendland-c2
///   alpha   1       viscosity
/// @derivation
///   At the air's pressure a parcel of mass M m takes the volume M m T / (rho_a T_a), so
///       rho_e = rho_a T_a / (T M)                                                                (1)
///   Linear in the density, without tension:
///       P = c^2 max(rho - rho_e, 0)                                                              (2)
///   dv_i/dt = - m sum_j [ P_i/rho_i^2 g(h_i) + P_j/rho_j^2 g(h_j) + Pi_ij (g(h_i) + g(h_j))/2 ] x   (3)
///   mu = h v.x / (x^2 + 0.01 h^2) where v.x < 0, else 0, with h the mean of both
///   Pi_ij = (-alpha c mu + 2 alpha mu^2) / rho with the means of both                             (4)
///   Every factor in (3) but x is symmetric in i and j, and sums of two floats commute: what i feels from j
///   is bit for bit the opposite of what j feels from i.
/// @source    [MON05] Monaghan, eqs. (3.3), (4.1), doi:10.1088/0034-4885/68/8/R01
/// @deviation the equation of state (2) replaces the ideal gas: c is far below the true speed of sound, so
/// that a
///            frame needs few steps; no correction for varying h
/// @valid     particles nearer than 1e-6 h are pushed apart along a direction drawn from their numbers
/// @accuracy  momentum is conserved to the rounding of the sums
/// @tests     tests/simulation/test_gas_kernels.cpp, tests/simulation/test_gas_solver.cpp
#pragma once

#include "simulation/sph/gas_store.h"
#include "simulation/sph/neighbor_grid.h"

namespace fx::sim {

constexpr float kAirDensity = 1.2041f; ///< [kg/m3] at kAirTemperature and sea level

/// (2) over the density squared: what enters (3).
float pressurePush(float density, float equilibrium, float sound);

/// Fills acceleration and approach of the sorted places [begin, end); Density, neighbors and Push are set for
/// all.
void sumForces(const NeighborGrid& grid, GasStore& gas, float viscosity, uint32_t begin, uint32_t end);

} // namespace fx::sim
