/// @file depth_sort.h
/// Sorts elements for drawing, by distance or age. Elements with equal keys keep the order of the list.
#pragma once

#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Radix sort. The object keeps its memory and its last order. If few elements have been moved, added or
/// removed since the last call, only the changed elements are sorted and merged into the last order. The
/// result equals the result of a full sort.
///
/// The sort is stable, so elements at equal distances do not flicker.
class DepthSort
{
public:
    /// Distance (NaN) of absent elements, which the result does not contain.
    static constexpr float kAbsent = std::numeric_limits<float>::quiet_NaN();

    explicit DepthSort(std::pmr::memory_resource* memory)
        : keys_(memory), order_(memory), changed_(memory), arrived_(memory), blockEnds_(memory),
          pairs_(memory), moved_(memory), scratch_(memory)
    {}

    /// Sorts elements by decreasing distance.
    /// @param distances [m] of any sign; elements with the distance NaN are omitted
    /// @return indices into `distances`, farthest first; valid until the next call
    std::span<const uint32_t> farthestFirst(std::span<const float> distances) { return sort(distances, ~0u); }
    /// Sorts elements by increasing distance. Arguments and result are as in farthestFirst().
    std::span<const uint32_t> nearestFirst(std::span<const float> distances) { return sort(distances, 0u); }

    void forget() { order_.clear(); } ///< discards the last order, so that the next call sorts all elements
    /// Number of elements that the last call sorted. The number is smaller than the number of returned
    /// elements if the call could reuse the previous order.
    size_t sortedElements() const { return sortedElements_; }

private:
    std::span<const uint32_t> sort(std::span<const float> distances, uint32_t flip);
    bool updateLastOrder(size_t changed, size_t newcomers);
    bool keepSorted(struct SortedPart& sorted);
    size_t take(std::span<const uint64_t> set, size_t count);
    void sortAll();
    void sortMoved(size_t count);

    /// Key of each element; ~0 for absent elements. The order of drawing is the order of ascending keys.
    std::pmr::vector<uint32_t> keys_;
    std::pmr::vector<uint32_t> order_;
    std::pmr::vector<uint64_t> changed_;   ///< bit set of elements whose keys differ from the previous call
    std::pmr::vector<uint64_t> arrived_;   ///< bit set of elements that were absent in the previous call
    std::pmr::vector<uint32_t> blockEnds_; ///< the last key of each block of sorted elements
    std::pmr::vector<uint64_t> pairs_;     ///< key * 2^32 + index
    std::pmr::vector<uint64_t> moved_;
    std::pmr::vector<uint64_t> scratch_;
    uint32_t lowest_ = 0, highest_ = 0; ///< smallest and largest key of the elements that are present
    size_t presentCount_ = 0;
    size_t sortedElements_ = 0;
};

} // namespace fx::render
