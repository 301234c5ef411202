/// @file gas_store.h
/// The particles of one body of gas, and the same particles sorted by cell for the loops over neighbors.
#pragma once

#include "foundation/memory/column.h"
#include "simulation/sph/wendland.h"

#include <array>
#include <cstdint>
#include <memory_resource>

namespace fx::sim {

/// State that lives from step to step.
namespace gas_column {
enum : size_t
{
    X, ///< [m] local
    Y,
    Z,
    VelocityX, ///< [m/s]
    VelocityY,
    VelocityZ,
    Smoothing,   ///< [m] smoothing length h
    Temperature, ///< [K]
    Mixing,      ///< [1] mass of the parcel with the air it has taken in, over its own mass; from 1 up
    Exposure,    ///< [1] 0 inside the body, 1 at its surface
    Vigor,       ///< [1] this particle's rate of cooling over the mean
    Soot,        ///< [1] part of the soot that has formed, 0..1, never falls
    AirX,        ///< [m/s] velocity of the air around it, from the beginning of the step
    AirY,
    AirZ,
    Presence, ///< [1] part of the smoke that has not yet dissolved, 1..0
    Count
};
}

/// What the loops over neighbors read and write, in the grid's order.
namespace gas_sorted {
enum : size_t
{
    X,
    Y,
    Z,
    VelocityX,
    VelocityY,
    VelocityZ,
    Smoothing,
    Sound,       ///< [m/s] reduced speed of sound
    Equilibrium, ///< [kg/m3] density at which the parcel is in balance with the air
    Density,     ///< [kg/m3]
    Push,        ///< [m5/(kg s2)] pressure over density squared
    Exposure,
    AccelerationX, ///< [m/s2]
    AccelerationY,
    AccelerationZ,
    Approach, ///< [m/s] largest viscous approach speed among the neighbors
    Count
};
}

/// Neighbors that are remembered from one loop to the next; a particle that has more is searched for anew.
constexpr uint32_t kMostListed = 128;

struct GasStore
{
    GasStore(std::pmr::memory_resource* memory, uint32_t capacity);

    float* at(size_t column) { return columns[column].data(); }
    const float* at(size_t column) const { return columns[column].data(); }
    float* sortedAt(size_t column) { return sorted[column].data(); }
    const float* sortedAt(size_t column) const { return sorted[column].data(); }

    uint32_t count = 0;
    float mass = 1; ///< [kg] of each particle
    std::array<base::Column<float>, gas_column::Count> columns;
    std::array<base::Column<float>, gas_sorted::Count> sorted;
    base::Column<Wendland> kernels; ///< of each sorted particle
    base::Column<uint32_t> listed; ///< kMostListed places a sorted particle: its neighbors, itself among them
    base::Column<uint32_t> pairs;  ///< neighbors found for each sorted particle
    base::Column<uint32_t> clamped; ///< values of each sorted particle that had to be limited
};

} // namespace fx::sim
