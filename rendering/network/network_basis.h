/// @file network_basis.h
/// Directions of the links between the cells of an illumination network, and the spherical harmonics in which
/// cells store light.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <span>
#include <vector>

namespace fx::render {

constexpr int kMaxNetworkDirections = 26;
constexpr int kMaxNetworkMoments = 9;

/// @formula neighbor-quadrature
/// Quadrature over the sphere with the directions from a cube to its neighbors.
///
/// symbol   unit   meaning
///   d        1      step to a neighbor, each coordinate -1, 0 or 1
///   w        sr     weight of the direction; all weights add up to 4 pi
///   Y_k      1      real orthonormal harmonic k = 0..8 of bands 0, 1 and 2
/// @derivation
///   By octahedral symmetry, sums of odd polynomials are 0. With the following weights of faces, edges and
///   corners, polynomials up to the given degree are integrated exactly:
///       6 faces: 4 pi / 6, degree 3                                                             (1)
///       6 faces and 8 corners: 4 pi / 15, 4 pi 3 / 40, degree 5                                 (2)
///       6 faces, 12 edges, 8 corners: 4 pi / 21, 4 pi 4 / 105, 4 pi 9 / 280, degree 7           (3)
///   Products of two harmonics have degree 2 (4 moments) or 4 (9 moments). So the harmonics of 4 moments are
///   orthonormal under (1), (2) and (3), those of 9 moments under (2) and (3).
/// @source    [LEB76] the weights
/// @deviation none
/// @valid     6, 14 or 26 directions
/// @accuracy  rounding: 1e-12 in double
/// @tests     tests/rendering/network/test_network_basis.cpp
struct NeighborDirection
{
    glm::ivec3 step{0};  ///< difference of cell indices
    int squares = 1;     ///< squared length of the step to the neighbor in cells, 1 to 3
    double weight = 0.0; ///< [sr]
};

/// Returns the directions with their weights. Opposite directions are consecutive. @param count number of
/// directions: 6, 14 or 26
std::vector<NeighborDirection> neighborDirections(int count);

/// Returns the values of all harmonics in a direction. @param direction unit vector
std::array<double, kMaxNetworkMoments> harmonics(const glm::dvec3& direction);
/// Returns the band of the harmonic with the index k: 0, 1 or 2.
constexpr int harmonicBand(int k)
{
    return k == 0 ? 0 : k < 4 ? 1 : 2;
}

} // namespace fx::render
