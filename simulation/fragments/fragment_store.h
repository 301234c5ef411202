/// @file fragment_store.h
/// The fragments of one instance, as columns of fixed capacity.
#pragma once

#include "foundation/memory/column.h"
#include "foundation/time/ticks.h"
#include "simulation/state/state_reader.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

namespace fx::sim {

namespace fragment_column {
enum : size_t
{
    X, ///< [m] local position
    Y,
    Z,
    VelocityX, ///< [m/s]
    VelocityY,
    VelocityZ,
    Size,        ///< [m] diameter
    Temperature, ///< [K]
    Hottest,     ///< [K] initial temperature
    Due,         ///< [m] distance to fly before the next blob of smoke
    Count
};
}

/// The fragments of one instance. Rows are in the order of fragment numbers.
struct FragmentStore
{
    /// [byte] Memory of a row.
    static constexpr uint64_t kRowBytes =
        2 * sizeof(uint32_t) + sizeof(base::Ticks) + fragment_column::Count * sizeof(float);

    FragmentStore(std::pmr::memory_resource* memory, size_t capacity);

    size_t capacity() const { return number.capacity(); }
    float* at(size_t column) { return attributes[column].data(); }
    const float* at(size_t column) const { return attributes[column].data(); }

    /// Removes the rows whose end is at or before `tick`. The order of the remaining rows does not change.
    void removeDead(base::Ticks tick);

    void save(StateWriter& writer) const;
    void restore(StateReader& reader);

    uint32_t count = 0;
    base::Column<uint32_t> number;  ///< index of the fragment in the burst
    base::Column<uint32_t> trailed; ///< number of blobs of smoke emitted so far
    base::Column<base::Ticks> dies; ///< local time at which the fragment is removed
    std::array<base::Column<float>, fragment_column::Count> attributes;
};

} // namespace fx::sim
