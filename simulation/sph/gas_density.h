/// @file gas_density.h
/// Density of the gas, how near each particle is to the surface, and the smoothing length that follows from
/// both.
///
/// @formula sph-density
/// Density by summation over neighbors, surface by the gradient of the same sum.
///
/// symbol   unit    meaning
///   m       kg      mass of a particle, the same for all
///   h       m       smoothing length
///   W, g            kernel and gradient factor, see wendland-c2
///   n       1/m3    number density
///   e       1       exposure: 0 deep inside, 1 on a free surface and for a lone particle
///   rho_e   kg/m3   density of balance with the air, see gas-forces
/// @derivation
///   n_i = sum_j W(r_ij, h_i), the particle itself included; rho_i = m n_i                        (1)
///   G_i = h_i |sum_j g(r_ij, h_i) (x_i - x_j)| / n_i                                              (2)
///   Inside a uniform body the sum vanishes. In the boundary plane of a half space
///       integral of W over the plane / (1/2) = (3/4 / h) / (1/2) = 3/2 / h, so G = 3/2
///   A lone particle has n = W(0, h) alone, a body at h = 1.2 spacings a quarter of that:
///       L_i = (W(0, h_i) / n_i - 0.3) / 0.5                                                       (3)
///       e_i = clamp(max(G_i / 1.2, L_i), 0, 1)
///   h_i = eta (m / rho_i)^(1/3), eta = 1.2: 58 neighbors                                          (4)
/// @source    [PRI12] Price, eqs. (6), (10), doi:10.1016/j.jcp.2010.12.011; the surface measure is ours
/// @deviation (4) is one fixed-point step for each time step, limited to a factor of 1.26, and bounded by 1.6
/// times
///            the size at balance and 0.02 times it: lone particles do not swell, coincident ones do not
///            vanish
/// @valid     finite positions
/// @accuracy  density of a uniform lattice within 3 %
/// @tests     tests/simulation/test_gas_kernels.cpp
#pragma once

#include "simulation/sph/gas_store.h"
#include "simulation/sph/neighbor_grid.h"

namespace fx::sim {

constexpr float kNeighborhood = 1.2f; ///< [1] eta: smoothing length over particle spacing

/// Fills density, exposure and pair counts of the sorted places [begin, end).
void sumDensity(const NeighborGrid& grid, GasStore& gas, uint32_t begin, uint32_t end);

/// The next smoothing length of a particle.
/// @param equilibrium [kg/m3] density of balance with the air, > 0
float adaptSmoothing(float smoothing, float mass, float density, float equilibrium);

} // namespace fx::sim
