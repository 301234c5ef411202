/// @file incremental_sort.h
/// Incremental sorting: keeps the sorted part of the last order and merges the moved elements. Vectorized
/// loops, compiled for each instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fx::render {

constexpr size_t kSortedBlock = 8; ///< sorted elements that share an entry of SortedPart::blockEnds

/// A scan of the last order; elements still in ascending order are compacted at its front.
struct SortedPart
{
    const uint32_t* keys; ///< by element
    uint32_t* order;      ///< [0, kept) is sorted, [at, count) is not scanned yet; kept <= at
    uint32_t* blockEnds;  ///< room for the last key of each sorted block
    size_t kept;
    size_t at;
    size_t count;
    uint64_t last;       ///< key * 2^32 + element of the last sorted element; 0 when it is empty
    uint64_t* displaced; ///< key * 2^32 + element of elements out of order
    size_t displacedCount;
    size_t mostDisplaced;
};

/// Continues while whole vectors of elements ascend, at most one element apart, and none is absent.
void extendSortedByVectors(SortedPart& sorted);

/// Removes the elements of the set `changed` from the last order; the rest is sorted.
/// @param changed see KeyChanges
void keepUnchanged(SortedPart& sorted, const uint8_t* changed);

/// Merges elements into the sorted part, whose order then holds all of them.
/// @param moved key * 2^32 + element, ascending  @param count so many entries are free behind the sorted part
void mergeMoved(const SortedPart& sorted, const uint64_t* moved, size_t count);

} // namespace fx::render
