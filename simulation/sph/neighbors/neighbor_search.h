/// @file neighbor_search.h
/// The neighbor search, compiled for each instruction set. One query of the tree finds the candidates of
/// eight leaves in all images. Each leaf selects the candidates near its box. Each owner tests the selected
/// candidates with vector instructions. No pair is lost to rounding. Boxes and pairs use the same order of
/// operations, and rounding is monotonic. Only boxes on periodic axes need a tolerance. Results have the same
/// bits for every instruction set.
#pragma once

#include "simulation/sph/neighbors/list_pool.h"
#include "simulation/sph/neighbors/particle_tree.h"

#include <array>
#include <cstdint>
#include <span>

namespace fx::sim {

/// An image of the particles. On each axis, the image is unchanged or mirrored in one wall. On every axis,
/// the difference of an owner at x and the image of a particle at x_j is (x - wall) - (sign x_j + shift).
template <class T>
struct SeenImage
{
    std::array<T, 3> wall{};  ///< [m] position of the wall; 0 on axes that are not mirrored
    std::array<T, 3> shift{}; ///< [m] equal to `wall`
    std::array<T, 3> sign{1, 1, 1};
    uint32_t bits = 0; ///< mirror bits of the entries of this image, kMirrorX << axis for each mirrored axis
};

/// Maximum number of images. Each of three axes has no mirror, the low wall or the high wall.
constexpr uint32_t kMaxImages = 27;

/// Inputs of a search.
template <class T>
struct SearchSetup
{
    TreeView<T> tree;
    PairImages<T> pairs;
    T scale = 1;              ///< 1 + margin
    bool wraps = false;       ///< true: an axis is periodic
    std::array<T, 3> slack{}; ///< [m] upper bound of the rounding errors of boxes on periodic axes
    uint32_t imageCount = 1;
    /// images in the ascending order of their bits; the first image is not mirrored
    std::array<SeenImage<T>, kMaxImages> images;
};

template <class T>
SearchSetup<T> searchSetup(const TreeView<T>& tree, const Domain& domain, T margin);

/// Searches the neighbors of `owners` and writes their lists, in ascending order of slots.
template <class T>
void listOwners(const SearchSetup<T>& setup, std::span<const uint32_t> owners, ListWriter& writer);

using ListPiece = void (*)(void* argument, const uint32_t* entries, uint32_t count, bool last);

/// Searches the neighbors of one slot and passes them to the caller in pieces, without storing a list.
template <class T>
void searchOwner(const SearchSetup<T>& setup, uint32_t owner, ListPiece piece, void* argument);

} // namespace fx::sim
