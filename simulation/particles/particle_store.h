/// @file particle_store.h
/// The particles of one emitter of one instance, stored in a ring of rows.
///
/// The particle with birth index i occupies row i mod capacity for its whole lifetime. The row depends only
/// on i. Therefore the rows do not depend on the division of time into steps, or on seeks. A birth whose row
/// is still occupied is dropped. Columns are filled in order of birth and never moved. All columns are in one
/// block of memory. The columns that every publication reads come first, so that a small emitter uses few
/// cache lines.
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

/// Rows that may hold living particles: the rows below `count` outside of [gapBegin, gapEnd).
struct RowWindow
{
    uint32_t count = 0;
    uint32_t gapBegin = 0;
    uint32_t gapEnd = 0;
};

/// A column in the memory of the store; null if the store does not have the column.
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
    /// Creates an empty store.
    /// @param capacity number of rows; 0: the capacity of the definition
    ParticleStore(const ParticleProgram& program, std::pmr::memory_resource* memory, uint32_t capacity = 0);

    /// [byte] Memory of a store with `capacity` rows.
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
    /// Prefetches the first cache lines that a publication reads.
    void fetch() const
    {
        __builtin_prefetch(brief_ ? static_cast<const void*>(bornShort.data()) : born.data());
        for (size_t a = 0; a < 3; ++a)
            __builtin_prefetch(values[stored::VelocityX + a].data());
    }
    /// Number of rows in the window.
    uint32_t rowsInUse() const { return uint32_t(std::min<uint64_t>(next_ - front_, capacity_)); }
    bool empty() const { return front_ == next_; }

    /// The value of an attribute in `row`, stored or not.
    float value(size_t column, uint32_t row) const
    {
        return values[column].data() ? values[column][row] : constant[column];
    }
    /// True if the particle in `row` is alive. The comparison is the same as in the kernels.
    bool isAlive(uint32_t row, base::Ticks now) const;
    /// [s] Age of the particle in `row`, with the same bits as in the kernels.
    float ageOf(uint32_t row, base::Ticks now) const;

    /// Marks the indices [next(), next() + count) as used by births.
    void advance(uint64_t count) { next_ += count; }
    uint64_t next() const { return next_; }
    /// Birth index of the oldest particle that may be alive; next() if no particle is alive.
    uint64_t front() const { return front_; }
    /// Removes rows without living particles at the old end of the window.
    void retire(base::Ticks now)
    {
        if (now >= frontUntil_)
            retireFront(now);
    }
    uint32_t countAlive(base::Ticks now) const;
    /// [tick] Time up to which the particles of all rows are certainly alive. Valid only if no event or
    /// module kills particles.
    base::Ticks allLiveUntil() const;
    bool isAnyAlive(base::Ticks now) const
    {
        return !empty() && (isAlive(rowOf(front_), now) || countAlive(now) > 0);
    }
    /// Empties all rows; the next birth has index `next`.
    void clear(uint64_t next);
    /// Empties all rows. The birth indices [front, next) count as used. The caller then writes particles with
    /// these indices to their rows, at least the particle `front`.
    void clear(uint64_t front, uint64_t next, base::Ticks now);
    /// Copies a particle from a store of the same program into `row`, with its index and birth.
    void copyRow(const ParticleStore& from, uint32_t fromRow, uint32_t row, const Birth& birth);
    /// Kills the particle in `row`. If the program is `brief`, the row counts as dead until it leaves the
    /// window, which takes at most 3 s.
    void endRow(uint32_t row, base::Ticks now);

    void save(StateWriter& writer, base::Ticks now) const;
    void saveEmpty(StateWriter& writer) const; ///< saves the store without particles, in the format of save()
    /// Restores the output of save().
    /// @param now [tick] local time of the state; the birth of a living particle is before `now`, and its
    /// death
    ///         after `now`
    void restore(StateReader& reader, base::Ticks now);

private:
    // Members that every step and publication reads, adjacent for the cache.
    uint64_t front_ = 0; ///< birth index of the oldest particle that may be alive
    uint64_t next_ = 0;
    /// Time at which the particle front_ dies of age.
    base::Ticks frontUntil_ = 0;
    uint32_t capacity_;
    bool brief_;
    bool mortal_;
    bool alwaysPlaced_;

public:
    bool placed; ///< false: all particles began at one position, so that the columns X, Y, Z are not used
    StoredColumn<uint32_t> bornShort; ///< low 32 bits of `born`; present only if the program is `brief`
    std::array<StoredColumn<float>, stored::Count> values; ///< empty if not stored
    StoredColumn<uint64_t> index;   ///< birth index of the particle that lives or last lived in the row
    StoredColumn<base::Ticks> born; ///< local time of the birth
    StoredColumn<uint32_t> flags;   ///< bits of tile_flag; present only if a module stores flags
    std::array<float, stored::Count> constant;

private:
    void restoreRow(StateReader& reader, base::Ticks now);
    void retireFront(base::Ticks now);
    void searchFront(base::Ticks now);

    base::Column<std::byte> memory_; ///< memory of all columns
};

/// The first tick after `from` at which the particle in `row` is dead, by (2) of particle-event-ticks. The
/// particle must be alive at `from` and dead at `to`.
base::Ticks deathTick(const ParticleStore& store, uint32_t row, base::Ticks from, base::Ticks to);

} // namespace fx::sim
