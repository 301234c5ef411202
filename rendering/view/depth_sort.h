/// @file depth_sort.h
/// Order of drawing: farthest first, ties by position in the list, whatever the number of elements.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Radix sort that keeps its memory. Stable: equal distances keep the order of the input, so that an image
/// does not flicker when several blobs are equally far.
class DepthSort
{
public:
    explicit DepthSort(std::pmr::memory_resource* memory) : keys_(memory), order_(memory), scratch_(memory) {}

    /// @param distances [m] finite, any sign
    /// @return indices into `distances`, farthest first; valid until the next call
    std::span<const uint32_t> farthestFirst(std::span<const float> distances);

private:
    std::pmr::vector<uint32_t> keys_;
    std::pmr::vector<uint32_t> order_;
    std::pmr::vector<uint32_t> scratch_;
};

} // namespace fx::render
