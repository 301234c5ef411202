/// @file incremental_sort.h
/// Incremental sort: the sorted part of the last order is kept, and moved elements are merged into the
/// sorted part. The loops are vectorized and compiled for each instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fx::render {

constexpr size_t kSortedBlock = 8; ///< number of sorted elements per entry of SortedPart::blockEnds

/// State of a scan of the last order. Elements that are still in ascending order are moved to the front of
/// the order.
struct SortedPart
{
    const uint32_t* keys; ///< key of each element
    uint32_t* order;      ///< elements: [0, kept) are sorted, [at, count) are not scanned yet; kept <= at
    uint32_t* blockEnds;  ///< memory for the last key of each sorted block
    size_t kept;
    size_t at;
    size_t count;
    uint64_t last;       ///< key * 2^32 + index of the last sorted element; 0 if no element is sorted
    uint64_t* displaced; ///< key * 2^32 + index of each element that is out of order
    size_t displacedCount;
    size_t mostDisplaced;
};

/// Continues the scan, one SIMD vector of elements at a time. The scan stops at a vector with an absent
/// element or with more than one element out of order, and when `displaced` is full.
void extendSortedByVectors(SortedPart& sorted);

/// Removes the elements of the set `changed` from the last order. The remaining elements are sorted.
/// @param changed see KeyChanges
void keepUnchanged(SortedPart& sorted, const uint8_t* changed);

/// Merges elements into the sorted part. Afterwards `sorted.order` contains all elements.
/// @param moved key * 2^32 + index of each moved element, in ascending order
/// @param count number of moved elements; SortedPart::order must have space for `count` elements behind its
///     sorted part
void mergeMoved(const SortedPart& sorted, const uint64_t* moved, size_t count);

} // namespace fx::render
