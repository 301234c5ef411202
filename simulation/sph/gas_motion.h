/// @file gas_motion.h
/// Moves gas particles through the air: pressure, buoyancy, turbulence, drag, ground.
///
/// @formula gas-motion
/// A sub-step of the gas: exact drag, then the new velocity carries the particle.
///
/// symbol   unit   meaning
///   a       m/s2   acceleration by neighbors (gas-forces)
///   b       m/s2   buoyancy
///   tau     1      T_air / T: density of the parcel over that of the air
///   u       m/s    velocity of the air: wind, the cloud's own circulation (hill-vortex), turbulence
///   k       1/s    drag rate of this particle
///   e       1      exposure (sph-density)
///   kd, kb         drag [1/s], braking [1/m]
/// @derivation
///   A parcel that moves through air carries half its displaced mass along, so Archimedes' force gives
///       b = -gravity (1 - tau) / (tau + 1/2), never more than twice gravity                       (1)
///   Exposed particles feel the air, inner ones their neighbors, so the body rolls over at its rim:
///       k = (kd + kb |v - u|) (1/5 + 4/5 e)                                                       (2)
///   v' = exp(-k t) v + (1 - exp(-k t)) u + G (a + b), G of linear-drag-step                       (3)
///   x' = x + t v': the order of (3) before this makes the pair symplectic where there is no drag   (4)
///   The ground takes the downward velocity, all but a tenth; pressure turns it sideways.            (5)
/// @source    [BAT67] Batchelor, section 6.4, for the added mass of a sphere in (1); (2) is ours
/// @deviation none
/// @valid     accelerations that are not finite count as 0; speed is limited to 20 c plus what the preset
/// sets
/// @accuracy  a lone particle without forces moves on a straight line exactly as x + v t rounds
/// @tests     tests/simulation/test_gas_solver.cpp
#pragma once

#include "simulation/motion/curl_noise.h"
#include "simulation/solver.h"
#include "simulation/sph/gas_def.h"
#include "simulation/sph/gas_store.h"
#include "simulation/sph/neighbor_grid.h"
#include "simulation/sph/thermal_flow.h"

namespace fx::sim {

/// What all particles of a step have in common.
struct GasMotion
{
    GasMotion(const GasDef& definition, const StepContext& context, const GasStore& gas);

    const GasDef& def;
    const StepContext& step;
    CurlNoise noise;
    ThermalFlow thermal;
    float fastest; ///< [m/s]
};

/// Sets the velocity of the air around the particles [begin, end), which holds for the whole step.
void sampleAir(const GasMotion& motion, GasStore& gas, uint32_t begin, uint32_t end);

/// Moves the particles at the sorted places [begin, end) by `seconds`.
void moveGas(const GasMotion& motion, const NeighborGrid& grid, GasStore& gas, float seconds, uint32_t begin,
             uint32_t end);

} // namespace fx::sim
