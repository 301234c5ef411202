/// @file glass.h
/// Particles without order: as even as a lattice, but without its planes, along which a flow would stay
/// locked.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace fx::sim {

/// A periodic box of count.x x count.y x count.z particles, in units of their mean distance: positions in
/// [0, count). A lattice is shaken, then relaxes by its own pressure. The same for the same arguments.
/// @param count at least 6 along each axis
/// @param neighbors of the relaxation, and of the flow that will use the box
std::vector<glm::dvec3> glassBox(const glm::u32vec3& count, double neighbors);

} // namespace fx::sim
