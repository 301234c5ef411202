/// @file density_loop.h
/// Density, support and velocity gradient at a particle.
///
/// @formula gas-density
/// Density by summation, the support radius that encloses a fixed mass, and gradients of the velocity.
///
/// symbol    unit     meaning
///   m        kg       mass of a particle
///   r        m        distance from particle i
///   H        m        radius of the support of i
///   q        1        r / H
///   w, C, e  1        shape and constant of the kernel, omitted share of the self-contribution: sph-kernels
///   N        1        nominal number of neighbors, 4/3 pi H^3 times the number density
///   S        kg       mass in units of the kernel, H^3 rho
///   D        kg       growth of S, H dS/dH
///   rho      kg/m3    density
///   f        1        correction of pressure forces for varying supports
///   d, u     m, m/s   position and velocity of i relative to a neighbor
///   M        kg m2    second moments of the neighborhood
///   G        kg m2/s  moments of velocity
///   J        1/s      gradient of the velocity, J_ab = d v_a / d x_b
///   E        kg m     first moments of the neighborhood
///   X        1/s      expansion, -drho/dt / rho as particles move
/// @derivation
///   S(H) = C [ (1 - e) m_i w(0) + sum m_j w(q) ],  rho = S / H^3                                (1)
///   H follows from H^3 rho(H) = 3 N m_i / (4 pi), that is S(H) = 3 N m_i / (4 pi)               (2)
///   D = -C sum m_j q w'(q) >= 0, so S grows with H and (2) has one solution. Newton's step is
///   H <- H (1 + (3 N m_i / (4 pi) - S) / D), kept inside of a shrinking bracket                 (3)
///   f = 1 / (1 + H / (3 rho) drho/dH) = 3 S / D, because H drho/dH = (D - 3 S) / H^3            (4)
///   With weights g = -m_j w'(q) / q:  M_ab = sum g d_a d_b,  G_ab = sum g u_a d_b,  J = G M^-1  (5)
///   (5) is exact for a velocity that is linear in space, for any arrangement of the particles.
///   div v = J_xx + J_yy + J_zz,  curl v = (J_zy - J_yz, J_xz - J_zx, J_yx - J_xy)               (6)
///   E_a = sum g d_a is zero inside of evenly sampled gas. On the plane surface of a half space of such gas,
///   with the Wendland C2 kernel, |E| = tr M / H.
///   Therefore the exposure is min(H |E| / tr M, 1); it is 1 without neighbors                    (7)
///   By (1) and (4), with dr/dt = u.d / r, the density by summation decreases at the relative rate
///       X = -f C / (H^5 rho) sum m_j u.d w'(q) / q = f C tr G / (H^5 rho)                        (8)
///   X differs from div v where particles are disordered or the flow is not linear over H, as in a shock
/// @source    [PRI12] sections 2 and 3 for (1), (2), (4), doi:10.1016/j.jcp.2010.12.011; [DA12] eq. (18) for
///            e; (5) is a least-squares fit
/// @deviation if the neighbors span no volume (det M below 1 % of that of a sphere of the same trace), J is
///            3 G / tr M. The iteration ends after a Newton step below sqrt(tolerance) / 2, because the next
///            step would square its error
/// @valid     m, H > 0, everything finite; masses and lengths whose products stay in the range of T
/// @accuracy  H within 2 tolerance of the solution; sums within 2e-6 (float), 1e-14 (double) of the sums of
///            their positive terms; every instruction set gives the same bits
/// @tests     tests/simulation/pair_loops/test_density_loop.cpp
#pragma once

#include "simulation/sph/pair_loops/pair_slots.h"
#include "simulation/sph/pair_loops/sph_kernel.h"

namespace fx::sim {

struct DensityRules
{
    SphKernel kernel = SphKernel::WendlandC2;
    /// [1] nominal number of neighbors N = 4/3 pi n H^3, with the number density n and the support H
    double neighbors = 58;
    double smallestSupport = 0;   ///< [m]
    double largestSupport = 1e30; ///< [m] >= smallestSupport
    double tolerance = 1e-4; ///< [1] relative tolerance of H in Newton's iteration (1e-7 in double precision)
    bool subtractSelfBias = true; ///< true: the term e of equation (1) is applied; false: e = 0
};

/// Results of the loop: arrays indexed by slot.
template <class T>
struct DensityResults
{
    T* support;          ///< [m] input: initial guess of the support H, > 0; output: H
    T* density;          ///< [kg/m3]
    T* correction;       ///< [1] correction f, in [0.2, 5]; 1 where H is the smallest or largest support
    T* divergence;       ///< [1/s] divergence of the velocity
    T* curl;             ///< [1/s] magnitude of the curl of the velocity
    uint8_t* wantsReach; ///< 1 if the solution for H exceeds the range of the list, else 0
    /// number of particles within H, including mirror images, without the particle itself
    uint32_t* neighbors;
    /// [1] exposure: 0 inside of evenly sampled gas, 1 on a free surface; null: not computed
    T* exposure = nullptr;
    T* expansion = nullptr; ///< [1/s] relative rate X of decrease of the density; null: not computed
};

template <class T>
struct DensityCall
{
    const DensityRules& rules;
    PairSlots<T> of;
    T reach; ///< [1] the lists contain all neighbors up to (1 + reach) times the guess of H
    const DensityResults<T>& results;
};

/// Computes density, support and velocity gradients of all slots. Reads x, y, z, velocity and mass of the
/// records. The support H is limited to (1 + reach) times its initial guess, because the lists are complete
/// only up to this distance. H is also limited to the bounds of the rules. A particle without neighbors gets
/// the largest possible support, and coincident particles get the smallest support. Equation (1) is evaluated
/// at most 20 times. All instruction sets give the same bits. The function runs on the calling thread; the
/// caller splits the work.
template <class T>
void sumDensity(const DensityCall<T>& call);

} // namespace fx::sim
