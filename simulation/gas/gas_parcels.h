/// @file gas_parcels.h
/// Data of each gas particle except its motion: the burning parcel and the optical properties.
#pragma once

#include "foundation/memory/column.h"
#include "simulation/combustion/fire_parcel.h"

#include <cstdint>
#include <memory_resource>

namespace fx::sim {

constexpr float kFaintest = 0.02f; ///< [1] presence below which smoke is not drawn

/// Arrays that are indexed by the id of a particle. The id never changes; the slot of a particle in the gas
/// changes.
struct GasParcels
{
    GasParcels(std::pmr::memory_resource* memory, uint32_t capacity)
        : fire(memory, capacity), vigor(memory, capacity), presence(memory, capacity)
    {}

    base::Column<FireParcel>
        fire; ///< burning parcels; FireParcel::temperature is the temperature at the pressure of the air
    base::Column<float> vigor;    ///< [1] mixing rate of the parcel divided by the mean rate
    base::Column<float> presence; ///< [1] fraction of the smoke that has not yet dissolved, from 1 to 0
};

} // namespace fx::sim
