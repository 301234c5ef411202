/// @file escape_depth.h
/// How deep voxels of a medium lie below what is seen from outside.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace fx::render {

constexpr float kMostEscapeDepth = 64.0f; ///< [1]

/// Voxels in blocks of 8 x 8 x 8, each of which has 512 values.
struct BlockLattice
{
    std::span<const glm::ivec3>
        blocks;                        ///< [block] coordinates, rising as for findBlock(), without duplicates
    glm::ivec3 strides{1, 8, 64};      ///< between the values of neighbors in a block along x, y, z
    std::span<const float> extinction; ///< [1/m] of all voxels
    double side = 1.0;                 ///< [m] of a voxel
};

/// @formula escape-depth
/// Share of the light of a voxel that leaves the medium, as an optical depth.
///
/// symbol   unit   meaning
///   v             voxel
///   d             one of 14 directions: to the neighbors along the axes, and to those at the corners
///   q_d      1    weight of a direction: 1/15 along an axis, 3/40 to a corner
///   k_v      1/m  extinction of a voxel
///   l_d      m    length of the way to the neighbor
///   t_d      1    optical depth from the center of the voxel to the outside
///   t        1    escape depth
///   e        1    share of the light of a voxel that is seen
///   S, j          source function and emitted light of the medium within a voxel
///
/// @derivation
///   By the trapezoidal rule from neighbor to neighbor
///       t_d(v) = l_d (k_v + k_{v+d}) / 2 + t_d(v+d), 0 outside of the blocks                  (1)
///   The share of isotropic light that leaves the medium is the mean of exp(-t_d) over all directions, by
///   the rule with 14 points on the sphere, which is exact for polynomials of degree 5
///       exp(-t) = sum_d q_d exp(-t_d)                                                         (2)
///   A voxel that is optically thick shows only the side of it that is seen. Its light is the mean of the
///   source function with the weight of what is seen, between voxels by linear interpolation of t:
///       j = k <k S exp(-t)> / <k exp(-t)>                                                     (3)
///   In a thin medium t is even within a voxel and (3) is the mean of the emitted light, <k S>; in a thick
///   one it is the extinction times the source function of the surface, so that the surface has its
///   luminance.
///   Where voxels are joined, exp(-t) in (3) is the mean of the whole voxel, which begins half of its way
///   before its center:
///       e = sum_d q_d exp(-(t_d - l_d k / 2)) (1 - exp(-l_d k)) / (l_d k)                     (4)
///   so that a thin voxel before a thick one counts as little as it hides of the thick one.
/// @source    [AS64] table 25.4, quadrature over a sphere, for the weights of (2); the rest is own
/// @deviation light that has left the blocks counts as seen, also if other blocks are behind; t is limited
///            to kMostEscapeDepth, in (4) to 16
/// @valid     extinction >= 0
/// @accuracy  (1) in an even medium, and (2) in a thin one, to rounding
/// @tests     tests/rendering/volumes/test_escape_depth.cpp

/// Escape depths (2) of all voxels, in the order of the extinctions.
std::vector<float> escapeDepths(const BlockLattice& lattice);

/// Shares (4) of all voxels, in the order of the extinctions; of voxels without extinction any value.
std::vector<float> seenShares(const BlockLattice& lattice);

} // namespace fx::render
