/// @file concentration_loop.h
/// Gradient of the particle concentration around a particle.
///
/// @formula particle-concentration
/// The gradient of a particle concentration that is steepest at the particles, and the direction out of the
/// gas.
///
/// symbol    unit   meaning
///   m        kg     mass of a particle
///   H        m      its support
///   d, r     m      position of i relative to j, its length
///   k        1      range over support
///   R        m      range of the concentration, k times the larger support of a pair
///   G        m      gradient
///   E        m      direction out of the gas
/// @derivation
///       G = sum over r < R of R 2 m_j / (m_i + m_j) (1 - r/R)^2 d/r                                (1)
///   points towards lower concentration. m_i times a summand is antisymmetric in the pair, so displacements
///   by a multiple of G do not move the center of mass.
///       E = sum over r < H of (1 - r^2/H^2) d                                                      (2)
///   is zero inside of evenly sampled gas and points outwards at a free surface.
/// @source    [LIN12] for displacement down a gradient of concentration; (1) and (2) are ours
/// @deviation the published concentration uses the kernel of the flow, whose gradient is zero at the
/// particles
/// @valid     H > 0, everything finite. Coincident pairs have no direction and add nothing
/// @accuracy  float rounding; every instruction set gives the same bits
/// @tests     tests/simulation/pair_loops/test_concentration_loop.cpp
#pragma once

#include "simulation/sph/pair_loops/pair_slots.h"

namespace fx::sim {

/// Results of the loop: arrays of the vectors G and E [m], indexed by slot.
template <class T>
struct ConcentrationResults
{
    T *x, *y, *z;                      ///< [m] vector G
    T *outwardX, *outwardY, *outwardZ; ///< [m] vector E
};

template <class T>
struct ConcentrationCall
{
    double range; ///< [1] range of the concentration over the support, in (0, 1]; the symbol k of the formula
    PairSlots<T> of;
    const ConcentrationResults<T>& results;
};

/// Computes G and E of all slots. Reads x, y, z, support and mass of the records. The lists must contain all
/// neighbors within the larger support. The function runs on the calling thread; the caller splits the work.
template <class T>
void sumConcentration(const ConcentrationCall<T>& call);

} // namespace fx::sim
