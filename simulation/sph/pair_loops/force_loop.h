/// @file force_loop.h
/// Pressure force, viscosity and heating, summed over neighbors.
///
/// @formula gas-pair-forces
/// Acceleration by pressure and viscosity, and heating by viscosity and conduction. Each pair conserves
/// momentum and energy.
///
/// symbol     unit        meaning
///   m         kg          mass of a particle
///   d, r      m           position of i relative to j, its length
///   v         m/s         velocity of i relative to j
///   H, rho                support and density: gas-density
///   F         1/m5        F_i = C / H_i^5 w'(q_i) / q_i, so that F_i d is the gradient of W(r; H_i)
///   p         m5/(kg s2)  push, f (P - P_ambient) / rho^2
///   c         m/s         speed of sound
///   mu        m/s         speed of approach, <= 0
///   s         m/s         signal speed
///   a, B      1           alpha of the viscosity switch, Balsara's factor
///   nu        m5/(kg s2)  viscosity of a pair
///   u         J/kg        specific thermal energy
///   b, k      1           the rules' beta and conductivity
/// @derivation
///   mu = min(v.d, 0) / r,  s = c_i + c_j - b mu                                              (1)
///   overbars, written x-, are means of both particles:  rho- = (rho_i + rho_j) / 2, likewise F-, a-, B-
///   nu = -1/2 a- B- mu s / rho-  >= 0                                                         (2)
///   dv_i/dt = -sum m_j (p_i F_i + p_j F_j + nu F-) d                                          (3)
///   heating by viscosity: sum m_j nu / 2 (v.d) F-, half of the kinetic energy that (3) removes    (4)
///   heating by conduction: sum m_j k sqrt(|P_i - P_j| / rho-) (u_i - u_j) / rho- r F-,
///   the heat flows from hot to cold, as F < 0, and is antisymmetric in the pair                  (5)
///   The bracket of (3) is symmetric in i and j bit for bit, and d is antisymmetric. Therefore the
///   acceleration of i by j over m_j is the exact opposite of the acceleration of j by i over m_i.
///   A pair nearer than 1e-6 of its mean support has no defined direction. Then d is set to a vector of
///   length 0.05 of the mean support. Its direction is hashed from both ids, with opposite results for i and
///   j. For an image in a wall it points away from the wall
///   (6)
/// @source    [PRI12] section 3 for pressure in (3), doi:10.1016/j.jcp.2010.12.011; [MON05] for (1), (2);
///            [PRI08] for (5), doi:10.1016/j.jcp.2008.08.011
/// @deviation (6); the heating does not contain pressure work, because the entropy form does not need it
/// @valid     m, H, rho > 0, everything finite
/// @accuracy  sums within 4e-6 (float), 2e-14 (double) of their absolute terms; every instruction set gives
///            the same bits
/// @tests     tests/simulation/pair_loops/test_force_loop.cpp
#pragma once

#include "simulation/sph/pair_loops/density_loop.h"

namespace fx::sim {

struct ForceRules
{
    SphKernel kernel = SphKernel::WendlandC2; ///< kernel; forces are unstable for more than
                                              ///< kernelFacts(kernel).largestNeighbors neighbors
    double beta = 3;                          ///< [1] coefficient beta of the signal speed
    double conductivity = 1;                  ///< [1] coefficient k of the conduction; 0: no conduction
    /// Ids of the particles, indexed by slot. The ids determine the direction in which coincident particles
    /// are pushed apart. Null: the slots are the ids.
    const uint32_t* ids = nullptr;
};

/// Results of the loop: arrays indexed by slot.
template <class T>
struct ForceResults
{
    T* ax; ///< [m/s2]
    T* ay;
    T* az;
    T* heating;     ///< [W/kg] heating by viscosity and conduction, without pressure work (entropy form)
    T* signalSpeed; ///< [m/s] largest signal speed over all pairs, at least 2 c
    /// [1] Smallest stepLevel of the neighbors within the larger support; the stepLevel of the particle if it
    /// has no neighbors.
    T* fastestNeighbor;
    uint32_t* pairs; ///< number of neighbors j with r < max(H_i, H_j), including mirror images
};

template <class T>
struct ForceCall
{
    const ForceRules& rules;
    PairSlots<T> of;
    const ForceResults<T>& results;
};

/// Computes accelerations of all slots: pressure with corrections for varying support, viscosity with signal
/// speed and limiter, and conduction. All instruction sets give the same bits. The function runs on the
/// calling thread; the caller splits the work.
template <class T>
void sumForces(const ForceCall<T>& call);

} // namespace fx::sim
