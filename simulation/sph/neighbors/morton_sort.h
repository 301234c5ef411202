/// @file morton_sort.h
/// Sorts particles along a Morton curve.
#pragma once

#include "foundation/memory/column.h"
#include "foundation/tasks/task_runner.h"
#include "simulation/sph/neighbors/domain.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

namespace fx::sim {

/// Radix sort of keys and indices. Particles are sorted by key, then by position within a cell of many
/// particles, then by index. The order is independent of the number of workers. The highest differing bits
/// are sorted first, then only the runs in which these bits are equal. Therefore a cluster in a wide cloud
/// costs no more than an even cloud. A cell of many particles has a separate Morton curve.
template <class T>
class MortonSort
{
public:
    MortonSort(std::pmr::memory_resource* memory, uint32_t capacity);

    /// Sorts particles along a curve. The curve fills the smallest cube that contains all particles and the
    /// whole length of periodic axes.
    /// @param axes three arrays of `count` coordinates [m]
    void sort(const std::array<const T*, 3>& axes, uint32_t count, const Domain& domain,
              base::TaskRunner& tasks);

    std::span<const uint64_t> keys() const { return keys_.first(count_); } ///< keys in ascending order
    /// Indices of the particles in the order of their keys.
    std::span<const uint32_t> order() const { return order_.first(count_); }
    /// Memory that the caller may use between two sorts.
    std::span<uint32_t> spare() { return spareOrder_.first(count_); }

private:
    struct Range;
    struct Digit;

    std::array<double, 6> boundsOfAll(base::TaskRunner& tasks);
    uint64_t keyOf(uint32_t index, const std::array<double, 3>& low, double perCell) const;
    void makeKeys(const Domain& domain, base::TaskRunner& tasks);
    uint64_t differingBits(Range range, base::TaskRunner& tasks) const;
    void sortRange(Range range, uint32_t depth, std::span<uint32_t> histogram, base::TaskRunner& tasks);
    void scatter(const uint64_t* from, uint64_t* to, Range range, Digit digit, std::span<uint32_t> histogram,
                 base::TaskRunner& tasks);
    void moveToWords(Range range, base::TaskRunner& tasks);
    void sortRuns(Range range, uint32_t lowBit, uint32_t depth, uint32_t blocks, base::TaskRunner& tasks);
    void sortRunsOf(Range range, uint32_t lowBit, uint32_t depth);
    void sortCell(Range range, uint32_t depth);
    void insert(uint32_t begin, uint32_t end);

    uint32_t count_ = 0;
    std::array<const T*, 3> axes_{}; ///< arrays of coordinates; valid during sort()
    base::Column<uint64_t> keys_;
    base::Column<uint32_t> order_;
    /// selected bits of a key in the upper bits, and the slot in the lower bits
    base::Column<uint64_t> words_;
    base::Column<uint64_t> spareWords_;
    base::Column<uint32_t> spareOrder_;
    base::Column<uint32_t> histogram_;           ///< histograms, one row per block
    base::Column<uint32_t> firstRun_;            ///< first slot of the runs that belong to each block
    base::Column<std::array<double, 6>> bounds_; ///< [m] bounds, low and high, of blocks of particles
};

extern template class MortonSort<float>;
extern template class MortonSort<double>;

} // namespace fx::sim
