/// @file gas_thermal.h
/// The flow of air caused by the whole cloud of a gas.
///
/// @formula gas-thermal
/// Position, size and speed of the vortex that represents a cloud of particles.
///
/// symbol   unit   meaning
///   q       m2     mean square distance from the center, by mass
///   a       m      radius of the sphere that the cloud fills
///   u       m/s    velocity of the air, formula hill-vortex
/// @derivation
///   The cloud is represented by a uniform ball with the same q:
///       a^2 = 5/3 q                                                                               (1)
///   It rises at the mean velocity of its mass relative to the wind, and never falls.
///   The circulation must not lift the cloud, so the mean of u over its particles is subtracted.    (2)
/// @source    elementary
/// @deviation none
/// @valid     any gas; without particles there is no flow
/// @accuracy  sums are in double precision, in the order of slots
/// @tests     tests/simulation/test_thermal_flow.cpp
#pragma once

#include "simulation/motion/thermal_flow.h"
#include "simulation/sph/dynamics/gas_dynamics.h"

namespace fx::sim {

/// Fits the flow of a thermal to the present state of a gas.
/// @param wind [m/s] wind that carries the cloud
ThermalFlow measureThermal(const GasView<const float>& gas, const glm::vec3& gravity, const glm::vec3& wind);

} // namespace fx::sim
