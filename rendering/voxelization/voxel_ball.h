/// @file voxel_ball.h
/// Input and output of voxelization: balls of medium, and blocks of voxels that they fill.
///
/// A voxel lattice is given by the side of a voxel [m]. Voxel (i, j, k) has its center at (i, j, k) times
/// that side in the world, so that the lattice is the same for all frames of a sequence.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace fx::render {

/// One ball with the quartic kernel of shaders/formulas/kernel_optical_depth.fx.h.
struct VoxelBall
{
    glm::dvec3 center{0.0};    ///< [m] world
    double radius = 0.0;       ///< [m] > 0
    double crossSection = 0.0; ///< [m2] > 0: the integral of its extinction over space
    double temperature = 0.0;  ///< [K]
    double luminance = 0.0;    ///< [cd/m2] emitted per optical depth
    glm::dvec3 velocity{0.0};  ///< [m/s] world
    uint64_t id = 0;           ///< of the ball in its effect
    uint64_t instance = 0;     ///< effect of the scene
};

constexpr int kBlockSide = 8; ///< [voxel]
constexpr int kBlockVoxels = kBlockSide * kBlockSide * kBlockSide;

/// A cube of voxels. Voxel (x, y, z) of the block is element (8 x + y) 8 + z of each array. A voxel without
/// medium is 0 in all of them.
struct VoxelBlock
{
    glm::ivec3 origin{0};                         ///< [voxel] of voxel (0, 0, 0); multiples of kBlockSide
    std::array<float, kBlockVoxels> density;      ///< [1/m] extinction
    std::array<float, kBlockVoxels> temperature;  ///< [K] mean, weighted with the extinction
    std::array<float, kBlockVoxels> flame;        ///< [cd/m3] luminance that a meter of the medium emits
    std::array<glm::vec3, kBlockVoxels> velocity; ///< [m/s] mean, weighted with the extinction
};

} // namespace fx::render
