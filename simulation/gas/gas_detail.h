/// @file gas_detail.h
/// Coordinates for the detail of the medium of one gas, formula material-coordinates.
#pragma once

#include "simulation/detail/material_coordinates.h"
#include "simulation/solver/solver.h"
#include "simulation/sph/dynamics/gas_dynamics.h"

namespace fx::sim {

/// Material coordinates of the particles of a gas. Rows are indexed by particle id.
class GasDetail
{
public:
    /// Creates coordinates for a number of particles.
    /// @param growth [1] radius of a drawn ball divided by half the support of its particle
    GasDetail(const FieldDetail& detail, float growth, uint32_t particles, std::pmr::memory_resource* memory)
        : detail_(detail), growth_(growth), coordinates_(memory, particles)
    {}

    /// Creates both generations after the release of the gas.
    void begin(const GasView<const float>& gas, base::Arena& scratch);
    /// Advances the generations after the gas has moved for `seconds`.
    void follow(const GasView<const float>& gas, double seconds, base::Arena& scratch);
    /// Adds the group of coordinates that belongs to the group of blobs added last.
    void publish(base::KindId kind, uint32_t capacity, base::FrameSnapshot& snapshot) const;
    void save(StateWriter& writer, uint32_t particles) const;
    void restore(StateReader& reader, uint32_t particles);

    /// [1/s] Shear rate S of equation (1).
    static double shearRate(const GasView<const float>& gas);

private:
    void bear(uint64_t generation, const GasView<const float>& gas);

    const FieldDetail& detail_;
    float growth_;
    MaterialCoordinates coordinates_;
    GenerationClock clock_;
    DetailGenerations shared_;
};

} // namespace fx::sim
