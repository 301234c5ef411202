/// @file voxel_ball.h
/// Input and output of voxelization: balls of medium, and blocks of voxels that they fill.
///
/// A voxel lattice is given by the side of a voxel [m]. The center of voxel (i, j, k) is at (i, j, k) times
/// this side in the world. Therefore the lattice is the same for all frames of a sequence.
#pragma once

#include "foundation/assets/voxel_volume.h"
#include "foundation/snapshot/block_kind.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace fx::render {

/// One ball with the quartic kernel of shaders/formulas/kernel_optical_depth.fx.h.
struct VoxelBall
{
    glm::dvec3 center{0.0};    ///< [m] position of the center in the world
    double radius = 0.0;       ///< [m] > 0
    double crossSection = 0.0; ///< [m2] integral of the ball's extinction over space, > 0
    double temperature = 0.0;  ///< [K]
    /// [cd/m2] Emitted luminance per optical depth. The color is that of a black body of the temperature.
    double luminance = 0.0;
    static constexpr double kUnknownAge = double(base::kSettledAge), kMostRate = 1e6;
    double luminanceRate = 0.0; ///< [1/s] change of its logarithm, within kMostRate; 0 also: not known
    double age = kUnknownAge;   ///< [s] since its birth; kUnknownAge: it has none, or it is not known
    glm::dvec3 velocity{0.0};   ///< [m/s] velocity in the world
    glm::dvec3 albedo{0.0};     ///< [1]
    glm::dvec3 streak{0.0};     ///< [m] way of the ball while the shutter is open; 0: none
    uint64_t id = 0;            ///< id of the ball in its effect
    uint64_t instance = 0;      ///< instance of the effect in the scene
};

constexpr int kBlockSide = 8; ///< [voxel] side of a block
constexpr int kBlockVoxels = kBlockSide * kBlockSide * kBlockSide;

/// A cube of voxels. Voxel (x, y, z) of the block is element (8 x + y) 8 + z of each array. The values of a
/// voxel without medium are 0 in all arrays.
struct VoxelBlock
{
    glm::ivec3 origin{0}; ///< [voxel] index of the block's first voxel; multiples of kBlockSide
    std::array<float, kBlockVoxels> density; ///< [1/m] extinction
    /// [K] color temperature of the emitted light; without light the mean, weighted with the extinction
    std::array<float, kBlockVoxels> temperature;
    std::array<float, kBlockVoxels> flame; ///< [cd/m3] luminance that the medium emits per meter
    /// [1/s] change of the logarithm of `flame` of the medium that moves through the voxel, if it keeps its
    /// density; within kMostVolumeRate
    std::array<float, kBlockVoxels> flameRate;
    std::array<glm::vec3, kBlockVoxels> velocity; ///< [m/s] mean, weighted with the extinction
    std::array<glm::vec3, kBlockVoxels> albedo;   ///< [1] mean, weighted with the extinction
};

} // namespace fx::render
