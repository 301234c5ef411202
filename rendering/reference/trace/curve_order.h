/// @file curve_order.h
/// Puts balls in an order in which neighbors in the list are neighbors in space.
#pragma once

#include "foundation/tasks/task_runner.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fx::render {

/// @formula hilbert-order
/// Place of a cell on the Hilbert curve through a cube of 2^20 cells a side.
///
/// symbol   unit   meaning
///   x_i    1      cell along axis i = 0, 1, 2, 20 bits each
///   Q      1      one bit of a cell number, from the highest down; P = Q - 1 are the bits below it
///   k      1      place on the curve, 60 bits
/// @derivation
///   For each Q: undo the turn that the curve has taken in the octant of that size. For each axis i, if x_i
///   has the bit Q then x_0 <- x_0 xor P, otherwise the bits P of x_0 and x_i are exchanged          (1) Gray
///   code: x_1 <- x_1 xor x_0, x_2 <- x_2 xor x_1; then every x_i is inverted below each set bit of x_2  (2)
///   k takes the bits of x_0, x_1, x_2 in turn, the highest first                               (3)
/// @source    [SKI04] the transposed form of the curve
/// @deviation branches are replaced by masks, and the inversions of (2) by one prefix sum modulo 2
/// @valid     x_i < 2^20
/// @accuracy  exact: a bijection onto [0, 2^60) on which successors are neighboring cells
/// @tests     tests/rendering/reference/trace/test_curve_order.cpp
struct CurveBatch
{
    static constexpr size_t kRoom = 256;
    size_t count = 0;                                  ///< at most kRoom
    std::array<std::array<uint32_t, kRoom>, 3> cell{}; ///< x_i of each
    std::array<uint64_t, kRoom> place{};               ///< k of each
};

/// Computes the places of the cells, which are used up.
void curvePlaces(CurveBatch& io);

/// A key and the index of its element.
struct KeyedIndex
{
    uint64_t key;
    uint32_t index;
};

/// Sorts by key; equal keys keep their order, so the result does not depend on the number of workers.
/// @param scratch is resized to the same length
void sortByKey(std::vector<KeyedIndex>& io, std::vector<KeyedIndex>& scratch, base::TaskRunner& tasks);

} // namespace fx::render
