/// @file glass.h
/// Glass-like particle arrangement. It is as even as a lattice, but has no lattice planes with which a flow
/// would stay aligned.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace fx::sim {

/// Creates a periodic box of count.x x count.y x count.z particles. The unit of positions is the mean
/// distance of particles, and positions are in [0, count). A lattice is perturbed and then relaxes by its own
/// pressure. Equal arguments give equal results.
/// @param count at least 6 along each axis
/// @param neighbors number of neighbors in the relaxation and in the flow that will use the box
std::vector<glm::dvec3> glassBox(const glm::u32vec3& count, double neighbors);

} // namespace fx::sim
