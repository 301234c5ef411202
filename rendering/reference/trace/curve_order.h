/// @file curve_order.h
/// Sorts balls along a Hilbert curve, so that balls that follow each other in the list are near each other in
/// space.
#pragma once

#include "foundation/tasks/task_runner.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fx::render {

/// @formula hilbert-order
/// Position of a cell on the Hilbert curve through a cube of 2^20 cells along each side.
///
/// symbol   unit   meaning
///   x_i    1      cell number along axis i = 0, 1, 2, 20 bits each
///   Q      1      one bit of a cell number, from the highest to the lowest; P = Q - 1 are the bits below it
///   k      1      position on the curve, 60 bits
/// @derivation
///   For each Q, the rotation of the curve in the octant of that size is reverted. For each axis i, if x_i
///   has the bit Q, then x_0 <- x_0 xor P; otherwise the bits P of x_0 and x_i are exchanged             (1)
///   Gray code: x_1 <- x_1 xor x_0, x_2 <- x_2 xor x_1; then all x_i are inverted below each set bit of
///   x_2                                                                                             (2)
///   k consists of the bits of x_0, x_1, x_2 interleaved, the highest first                          (3)
/// @source    [SKI04] the transposed form of the curve
/// @deviation branches are replaced by masks, and the inversions of (2) by one prefix sum modulo 2
/// @valid     x_i < 2^20
/// @accuracy  exact: a bijection onto [0, 2^60) in which consecutive positions are neighboring cells
/// @tests     tests/rendering/reference/trace/test_curve_order.cpp
struct CurveBatch
{
    static constexpr size_t kRoom = 256;
    size_t count = 0;                                  ///< number of cells in use, at most kRoom
    std::array<std::array<uint32_t, kRoom>, 3> cell{}; ///< x_i of each cell
    std::array<uint64_t, kRoom> place{};               ///< k of each cell
};

/// Computes the positions of the cells along the curve. The content of `cell` is overwritten.
void curvePlaces(CurveBatch& io);

/// A key and the index of its element.
struct KeyedIndex
{
    uint64_t key;
    uint32_t index;
};

/// Sorts by key. The order of equal keys does not change, so that the result does not depend on the number of
/// workers.
/// @param scratch memory that is overwritten and resized to the length of `io`
void sortByKey(std::vector<KeyedIndex>& io, std::vector<KeyedIndex>& scratch, base::TaskRunner& tasks);

} // namespace fx::render
