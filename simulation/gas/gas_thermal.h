/// @file gas_thermal.h
/// The flow of air that a gas makes as a whole.
///
/// @formula gas-thermal
/// Place, size and speed of the vortex that stands for a cloud of particles.
///
/// symbol   unit   meaning
///   q       m2     mean square distance from the center, by mass
///   a       m      radius of the sphere that the cloud fills
///   u       m/s    velocity of the air, formula hill-vortex
/// @derivation
///   The cloud's sphere is that of a uniform ball with the same q:
///       a^2 = 5/3 q                                                                               (1)
///   It rises at the mean velocity of the mass against the wind, never falls.
///   What turns the cloud over must not lift it: the mean of u over its particles is taken off.     (2)
/// @source    elementary
/// @deviation none
/// @valid     any gas; one without particles makes no flow
/// @accuracy  sums are of double precision, in the order of the particles' places
/// @tests     tests/simulation/test_thermal_flow.cpp
#pragma once

#include "simulation/motion/thermal_flow.h"
#include "simulation/sph/dynamics/gas_dynamics.h"

namespace fx::sim {

/// @param wind [m/s] in which the cloud drifts
ThermalFlow measureThermal(const GasView<const float>& gas, const glm::vec3& gravity, const glm::vec3& wind);

} // namespace fx::sim
