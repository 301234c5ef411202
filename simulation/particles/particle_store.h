/// @file particle_store.h
/// The particles of one emitter of one instance: a ring of rows.
///
/// The particle with birth index i occupies row i mod capacity for its whole lifetime. The row depends on
/// nothing else, so any division of time into steps, and any seek, gives the same rows. A birth whose row is
/// still occupied is dropped. Columns are filled in order of birth and never moved. All are in one block of
/// memory, beginning with those that every publication reads, so that a small emitter uses few cache lines.
#pragma once

#include "foundation/memory/column.h"
#include "simulation/particles/particle_program.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>

namespace fx::sim {

struct Birth;

constexpr uint64_t kNoParticle = ~uint64_t(0); ///< birth index of a row that no particle has used

/// Rows that may hold living particles: those below `count` outside of [gapBegin, gapEnd).
struct RowWindow
{
    uint32_t count = 0;
    uint32_t gapBegin = 0;
    uint32_t gapEnd = 0;
};

/// A column of a store, in the store's memory; null when the store has none.
template <class T>
class StoredColumn
{
public:
    StoredColumn() = default;
    explicit StoredColumn(T* rows) : rows_(rows) {}
    T* data() { return rows_; }
    const T* data() const { return rows_; }
    T& operator[](size_t row) { return rows_[row]; }
    const T& operator[](size_t row) const { return rows_[row]; }

private:
    T* rows_ = nullptr;
};

class ParticleStore
{
public:
    /// @param capacity rows; 0: the capacity of the definition
    ParticleStore(const ParticleProgram& program, std::pmr::memory_resource* memory, uint32_t capacity = 0);

    /// [byte] memory of a store with `capacity` rows.
    static size_t bytesOf(const ParticleProgram& program, uint32_t capacity);

    uint32_t capacity() const { return capacity_; }
    uint32_t rowOf(uint64_t particle) const { return uint32_t(particle % capacity_); }
    RowWindow window() const
    {
        if (empty())
            return {};
        if (next_ - front_ >= capacity_)
            return {capacity_, capacity_, capacity_};
        const uint32_t first = rowOf(front_);
        const uint32_t end = rowOf(next_);
        if (first < end)
            return {end, 0, first};
        return {capacity_, end, first};
    }
    /// Prefetches the first data that a publication reads.
    void fetch() const
    {
        __builtin_prefetch(brief_ ? static_cast<const void*>(bornShort.data()) : born.data());
        for (size_t a = 0; a < 3; ++a)
            __builtin_prefetch(values[stored::VelocityX + a].data());
    }
    /// How many the window has.
    uint32_t rowsInUse() const { return uint32_t(std::min<uint64_t>(next_ - front_, capacity_)); }
    bool empty() const { return front_ == next_; }

    /// The value of an attribute in `row`, stored or not.
    float value(size_t column, uint32_t row) const
    {
        return values[column].data() ? values[column][row] : constant[column];
    }
    /// The same comparison that the kernels make.
    bool isAlive(uint32_t row, base::Ticks now) const;
    /// [s] the same age that the kernels compute.
    float ageOf(uint32_t row, base::Ticks now) const;

    /// The next indices [next(), next() + count) have been given out.
    void advance(uint64_t count) { next_ += count; }
    uint64_t next() const { return next_; }
    uint64_t front() const { return front_; } ///< the oldest index that may be alive; next() when none does
    /// Drops empty rows at the old end of the window.
    void retire(base::Ticks now)
    {
        if (now >= frontUntil_)
            retireFront(now);
    }
    uint32_t countAlive(base::Ticks now) const;
    /// [tick] time up to which the particles of all rows are alive for certain; valid only where particles
    /// die of age alone.
    base::Ticks allLiveUntil() const;
    bool isAnyAlive(base::Ticks now) const
    {
        return !empty() && (isAlive(rowOf(front_), now) || countAlive(now) > 0);
    }
    /// Empties all rows; the next birth has index `next`.
    void clear(uint64_t next);
    /// The same where the indices [front, next) have been given out: `front` and maybe more of them are going
    /// to be put into their rows.
    void clear(uint64_t front, uint64_t next, base::Ticks now);
    /// Copies a particle of a store of the same program into `row`, as the one of that index and birth.
    void copyRow(const ParticleStore& from, uint32_t fromRow, uint32_t row, const Birth& birth);
    /// Ends the particle in `row`. For brief lives: until it leaves the window, at most 3 s from now.
    void endRow(uint32_t row, base::Ticks now);

    void save(StateWriter& writer, base::Ticks now) const;
    void saveEmpty(StateWriter& writer) const; ///< the same, once all particles of now are dead
    /// @param now [tick] local time of the state: living particles are born before it and die after it
    void restore(StateReader& reader, base::Ticks now);

private:
    // Members that every step and publication reads, adjacent for the cache.
    uint64_t front_ = 0; ///< the oldest index that may be alive
    uint64_t next_ = 0;
    base::Ticks frontUntil_ = 0; ///< time until which the particle lives, unless an event kills it earlier
    uint32_t capacity_;
    bool brief_;
    bool mortal_;
    bool alwaysPlaced_;

public:
    bool placed;                      ///< false: all motion began at one place, X, Y, Z are not in use yet
    StoredColumn<uint32_t> bornShort; ///< low 32 bits of `born`, where lives are brief
    std::array<StoredColumn<float>, stored::Count> values; ///< empty when not stored
    StoredColumn<uint64_t> index;                          ///< of the particle that lives or lived in the row
    StoredColumn<base::Ticks> born;                        ///< local time
    StoredColumn<uint32_t> flags;                          ///< tile_flag, where modules keep any
    std::array<float, stored::Count> constant;

private:
    void restoreRow(StateReader& reader, base::Ticks now);
    void retireFront(base::Ticks now);
    void searchFront(base::Ticks now);

    base::Column<std::byte> memory_; ///< of all columns
};

/// The first tick, after `from`, at which the particle in `row` does not live; it lives at `from` and not at
/// `to`: (2) of particle-event-ticks.
base::Ticks deathTick(const ParticleStore& store, uint32_t row, base::Ticks from, base::Ticks to);

} // namespace fx::sim
