/// @file trail_store.h
/// The blobs of smoke behind the fragments of one instance, as columns of fixed capacity.
#pragma once

#include "foundation/memory/column.h"
#include "foundation/time/ticks.h"
#include "simulation/state/state_reader.h"

#include <array>
#include <cstdint>
#include <memory_resource>

namespace fx::sim {

namespace trail_column {
enum : size_t
{
    X, ///< [m] local position
    Y,
    Z,
    VelocityX, ///< [m/s]
    VelocityY,
    VelocityZ,
    Radius,       ///< [m] at birth
    CrossSection, ///< [m2] at birth
    Count
};
}

/// Id of a blob of a fragment. The id does not depend on the length of steps.
constexpr uint64_t trailId(uint32_t fragment, uint32_t blob)
{
    return (uint64_t(fragment) << 24) | (blob & 0xFFFFFFu);
}

/// Number of the fragment in a trailId.
constexpr uint64_t trailFragment(uint64_t id)
{
    return id >> 24;
}

/// Columns of blobs, with rows in the order of creation. Memory is reserved for a typical number of rows, and
/// grows if more rows are needed.
class TrailStore
{
public:
    /// Creates an empty store.
    /// @param most      maximum number of rows
    /// @param fragments number of fragments that leave blobs
    TrailStore(std::pmr::memory_resource* memory, size_t most, size_t fragments);

    size_t capacity() const { return most_; }     ///< largest number of rows
    size_t held() const { return id.capacity(); } ///< number of rows for which memory is reserved
    /// Reserves memory for `rows` rows, at most capacity(). If memory grows, it at least doubles. Strong
    /// guarantee.
    void reserve(size_t rows);
    /// [byte] Memory of this number of rows and fragments.
    static uint64_t bytesOf(size_t rows, size_t fragments);
    float* at(size_t column) { return attributes[column].data(); }
    const float* at(size_t column) const { return attributes[column].data(); }

    /// Removes the rows whose end is at or before `tick`. The order of the remaining rows does not change.
    void removeDead(base::Ticks tick);
    /// Fills `order`. The time is linear in the numbers of rows and fragments.
    void sort();

    void save(StateWriter& writer) const;
    /// Restores the output of save().
    /// @param now local time of the state
    void restore(StateReader& reader, base::Ticks now);

    uint32_t count = 0;
    base::Column<uint64_t> id;      ///< trailId
    base::Column<base::Ticks> born; ///< local time
    base::Column<base::Ticks> dies; ///< local time
    std::array<base::Column<float>, trail_column::Count> attributes;
    base::Column<uint32_t> order; ///< rows by ascending id, as of the last sort() or restore()

private:
    std::pmr::memory_resource* memory_;
    size_t most_;
    base::Column<uint32_t> next_; ///< of sort(): next place in the order of each fragment
};

} // namespace fx::sim
