/// @file emitter_store.h
/// The particles of one emitter of one instance, as columns of fixed capacity.
#pragma once

#include "foundation/memory/column.h"
#include "foundation/time/ticks.h"
#include "simulation/state/state_reader.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

namespace fx::sim {

/// Float attributes of a particle. Those drawn at birth stay as they were; curves over life multiply them.
namespace emitter_column {
enum : size_t
{
    X, ///< [m] local
    Y,
    Z,
    VelocityX, ///< [m/s]
    VelocityY,
    VelocityZ,
    Radius,       ///< [m] at birth
    CrossSection, ///< [m2] at birth
    Excess,       ///< [K] temperature above the air's at birth
    Count
};
}

/// Rows in the order of birth, so that indices ascend.
struct EmitterStore
{
    EmitterStore(std::pmr::memory_resource* memory, size_t capacity);

    size_t capacity() const { return index.capacity(); }
    float* at(size_t column) { return attributes[column].data(); }
    const float* at(size_t column) const { return attributes[column].data(); }

    /// Removes the rows of [first, count) whose death is not after `tick`; the others keep their order.
    /// @param kept room for count - first row numbers
    void removeDead(uint32_t first, base::Ticks tick, std::span<uint32_t> kept);

    void save(StateWriter& writer) const;
    /// @param now [tick] local time of the state: what is alive was born before it and dies after it
    void restore(StateReader& reader, base::Ticks now);

    uint32_t count = 0;
    base::Column<uint64_t> index;   ///< running number within the emitter
    base::Column<base::Ticks> born; ///< local time
    base::Column<base::Ticks> dies; ///< local time
    std::array<base::Column<float>, emitter_column::Count> attributes;
};

} // namespace fx::sim
