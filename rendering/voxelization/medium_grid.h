/// @file medium_grid.h
/// A participating medium on a sparse lattice of voxels, as files of other programs hold it.
///
/// The lattice is any linear image of the integers: voxels may be rotated, sheared, and of unequal sides.
/// Only blocks of 8 x 8 x 8 voxels that have medium are stored.
#pragma once

#include "foundation/result/status.h"
#include "rendering/voxelization/voxel_ball.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fx::render {

/// The arrays of voxels have kBlockVoxels elements for each block, in the order of VoxelBlock. An array of
/// another quantity than the density may be empty: the medium does not have it.
struct MediumGrid
{
    glm::dmat3 axes{1.0};              ///< [m] columns: the way from a voxel to its neighbor along x, y, z
    glm::dvec3 origin{0.0};            ///< [m] center of the voxel (0, 0, 0)
    std::vector<glm::ivec3> blocks;    ///< [voxel] first voxels of blocks, rising by x, then y, then z
    std::vector<float> density;        ///< [1/m] extinction, >= 0
    std::vector<float> temperature;    ///< [K] >= 0
    std::vector<float> flame;          ///< [cd/m3] luminance that a meter of the medium emits, >= 0
    std::vector<float> flameRate;      ///< [1/s] of VoxelBlock, within kMostVolumeRate
    std::vector<glm::vec3> albedo;     ///< [1] 0..1
    std::vector<glm::vec3> velocity;   ///< [m/s] world
    double anisotropy = 0.0;           ///< [1] mean cosine of the scattering angle, -0.95 to 0.95
    std::vector<VoxelBall> balls;      ///< medium beside the voxels, rising by instance, then id
    std::vector<std::string> warnings; ///< what was not taken from the file as it is

    /// [m] center of a voxel; its index may have fractions.
    glm::dvec3 place(const glm::dvec3& voxel) const { return origin + axes * voxel; }
    /// [m3] of a voxel
    double voxelVolume() const;
};

/// Sums over the voxels that have medium.
struct MediumGridSums
{
    uint64_t voxels = 0;
    glm::ivec3 low{0}, high{0};       ///< [voxel] first and last of the box around them
    glm::dvec3 boxLow{0}, boxHigh{0}; ///< [m] world box around their centers
    double crossSection = 0.0;        ///< [m2] integral of the extinction over space
    glm::dvec3 center{0.0};           ///< [m] center of the extinction
    double largestDensity = 0.0;      ///< [1/m]
    double temperature = 0.0;         ///< [K] mean, weighted with the extinction
    double luminousVolume = 0.0;      ///< [cd] integral of `flame` over space
};

MediumGridSums sumsOf(const MediumGrid& grid);

/// Index in the arrays of a block of the voxel with these coordinates in it, each 0..7.
constexpr size_t voxelInBlock(int x, int y, int z)
{
    return size_t((x * kBlockSide + y) * kBlockSide + z);
}

constexpr double kMostAnisotropy = 0.95; ///< as of presets
constexpr size_t kMostGridBalls = size_t(1) << 20;

/// Whether the numbers of a ball are finite and in the ranges of files of balls
/// (simulation/cloud/ball_list.h).
bool isInRange(const VoxelBall& ball);

/// The grid as bytes of this machine, for another process.
std::string toBytes(const MediumGrid& grid);

/// Inverse of toBytes(). Trusts nothing: sizes are compared with the number of bytes before memory is
/// allocated, blocks must rise, and numbers must be in their ranges.
/// @return Parse with what is wrong
base::Result<MediumGrid> mediumGridFromBytes(std::string_view bytes);

} // namespace fx::render
