/// @file neighbor_search.h
/// The search, compiled for each instruction set. Owners of eight leaves together query the tree for
/// candidates, in all images; every leaf filters those near its own box; every owner tests these with
/// vectors. All bounds are exact in floating point: differences, squares and their sums are taken in the same
/// order for boxes as for pairs, rounding is monotonic, and so no pair is lost. Only boxes on periodic axes
/// need a tolerance. Results are the same bits for every instruction set.
#pragma once

#include "simulation/sph/neighbors/list_pool.h"
#include "simulation/sph/neighbors/particle_tree.h"

#include <array>
#include <cstdint>
#include <span>

namespace fx::sim {

/// An image of the particles: unchanged, or mirrored in one wall of some axes. The difference of an owner at
/// x and a particle at x_j is (x - wall) - (sign x_j + shift) on every axis.
template <class T>
struct SeenImage
{
    std::array<T, 3> wall{};  ///< [m] 0 where not mirrored
    std::array<T, 3> shift{}; ///< [m] the wall again, 0 where not mirrored
    std::array<T, 3> sign{1, 1, 1};
    uint32_t bits = 0; ///< of the entries, kMirrorX << axis
};

constexpr uint32_t kMaxImages = 27; ///< nothing, the low or the high wall on each of three axes

/// Inputs of a search.
template <class T>
struct SearchSetup
{
    TreeView<T> tree;
    PairImages<T> pairs;
    T scale = 1;              ///< 1 + margin
    bool wraps = false;       ///< some axis is periodic
    std::array<T, 3> slack{}; ///< [m] bound of rounding errors of boxes on periodic axes
    uint32_t imageCount = 1;
    std::array<SeenImage<T>, kMaxImages> images; ///< ascending by bits; the first is no mirror
};

template <class T>
SearchSetup<T> searchSetup(const TreeView<T>& tree, const Domain& domain, T margin);

/// Lists for slots in ascending order.
template <class T>
void listOwners(const SearchSetup<T>& setup, std::span<const uint32_t> owners, ListWriter& writer);

using ListPiece = void (*)(void* argument, const uint32_t* entries, uint32_t count, bool last);

/// The list of one slot in pieces, without memory for it.
template <class T>
void searchOwner(const SearchSetup<T>& setup, uint32_t owner, ListPiece piece, void* argument);

} // namespace fx::sim
