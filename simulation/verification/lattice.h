/// @file lattice.h
/// Particles on cubic lattices.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace fx::sim {

/// Points at the centers of cubic cells.
struct Lattice
{
    glm::dvec3 low;     ///< [m] lower corner of the lattice
    double spacing;     ///< [m]
    glm::u32vec3 count; ///< number of cells along each axis

    /// Calls f(position) for all points, x fastest.
    template <class F>
    void forEach(F&& f) const
    {
        for (uint32_t k = 0; k < count.z; ++k) {
            for (uint32_t j = 0; j < count.y; ++j) {
                for (uint32_t i = 0; i < count.x; ++i)
                    f(low + spacing * glm::dvec3(i + 0.5, j + 0.5, k + 0.5));
            }
        }
    }
};

/// The even integer, at least `least`, whose cube is nearest to `particles`. With an even side, no particle
/// is at the center of a cube. Therefore an event at the center affects the nearest particles equally.
uint32_t evenSide(uint32_t particles, uint32_t least);

/// Rounds `value` up to an even number.
uint32_t evenAbove(double value);

/// [1] Ratio of the support H to the spacing of a lattice with 4/3 pi n H^3 = neighbors, where n is the
/// number density.
double supportInSpacings(double neighbors);

} // namespace fx::sim
