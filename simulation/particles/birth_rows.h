/// @file birth_rows.h
/// Rows of the births of a tile, in one emitter or in many emitters.
#pragma once

#include "simulation/particles/birth_kernel.h"
#include "simulation/particles/birth_lanes.h"

#include <algorithm>

namespace fx::sim {

/// Births of one emitter in consecutive rows, up to the end of the ring.
class RowsOfOne
{
public:
    static constexpr bool kAreFree = false; ///< false: rows may be occupied and must be tested
    RowsOfOne(std::span<const Birth> births, ParticleStore& store) : births_(births), store_(store) {}

    uint32_t count() const { return uint32_t(births_.size()); }
    const Birth& birth(uint32_t i) const { return births_[i]; }
    ParticleStore& first() const { return store_; }
    void prepare(BirthTile& tile) const
    {
        tile.seedsDiffer = false;
        for (uint32_t i = 0; i < padded(); ++i)
            setIndex(tile, i, births_[0].index + i);
    }
    /// Calls f(store, row, i) for all births.
    template <class F>
    void forEach(F&& f) const
    {
        uint32_t row = store_.rowOf(births_[0].index);
        for (uint32_t i = 0; i < count(); ++i) {
            f(store_, row, i);
            row = row + 1 == store_.capacity() ? 0 : row + 1;
        }
    }
    /// Pointer to the first value of a column if the rows are contiguous; null if not.
    float* run(size_t column) const
    {
        const uint32_t row = store_.rowOf(births_[0].index);
        return row + count() <= store_.capacity() ? store_.values[column].data() + row : nullptr;
    }
    static void setIndex(BirthTile& tile, uint32_t i, uint64_t index)
    {
        tile.indexLow[i] = uint32_t(index);
        tile.indexHigh[i] = uint32_t(index >> 32);
    }

private:
    uint32_t padded() const { return (count() + kTilePadding - 1) / kTilePadding * kTilePadding; }

    std::span<const Birth> births_;
    ParticleStore& store_;
};

/// Births of many emitters in one shared store.
class RowsOfPool
{
public:
    static constexpr bool kAreFree = true; ///< true: rows are known to be free
    RowsOfPool(std::span<const PooledBirth> births, ParticleStore& store) : births_(births), store_(store) {}

    uint32_t count() const { return uint32_t(births_.size()); }
    const Birth& birth(uint32_t i) const { return births_[i].row; }
    ParticleStore& first() const { return store_; }
    void prepare(BirthTile& tile) const
    {
        tile.seedsDiffer = true;
        const uint32_t padded = (count() + kTilePadding - 1) / kTilePadding * kTilePadding;
        for (uint32_t i = 0; i < padded; ++i) {
            const PooledBirth& from = births_[std::min(i, count() - 1)];
            RowsOfOne::setIndex(tile, i, from.index);
            tile.seedLow[i] = uint32_t(from.seed);
            tile.seedHigh[i] = uint32_t(from.seed >> 32);
        }
    }
    template <class F>
    void forEach(F&& f) const
    {
        uint32_t row = store_.rowOf(births_[0].row.index);
        for (uint32_t i = 0; i < count(); ++i) {
            f(store_, row, i);
            row = row + 1 == store_.capacity() ? 0 : row + 1;
        }
    }
    float* run(size_t column) const
    {
        const uint32_t row = store_.rowOf(births_[0].row.index);
        return row + count() <= store_.capacity() ? store_.values[column].data() + row : nullptr;
    }

private:
    std::span<const PooledBirth> births_;
    ParticleStore& store_;
};

/// Births of many emitters, each in its own store.
class RowsOfMany
{
public:
    static constexpr bool kAreFree = false; ///< false: rows may be occupied and must be tested
    explicit RowsOfMany(std::span<ScatteredBirth> births) : births_(births) {}

    uint32_t count() const { return uint32_t(births_.size()); }
    const Birth& birth(uint32_t i) const { return births_[i].birth; }
    ParticleStore& first() const { return *births_[0].store; }
    void prepare(BirthTile& tile) const
    {
        tile.seedsDiffer = true;
        const uint32_t padded = (count() + kTilePadding - 1) / kTilePadding * kTilePadding;
        for (uint32_t i = 0; i < padded; ++i) {
            const ScatteredBirth& from = births_[std::min(i, count() - 1)];
            RowsOfOne::setIndex(tile, i, from.birth.index);
            tile.seedLow[i] = uint32_t(from.seed);
            tile.seedHigh[i] = uint32_t(from.seed >> 32);
        }
    }
    template <class F>
    void forEach(F&& f) const
    {
        for (uint32_t i = 0; i < count(); ++i)
            f(*births_[i].store, births_[i].row, i);
    }
    float* run(size_t) const { return nullptr; }

private:
    std::span<ScatteredBirth> births_;
};

} // namespace fx::sim
