/// @file voxel_volume.h
/// A participating medium on a sparse lattice of cubic voxels.
///
/// Values belong to the centers of voxels and are interpolated linearly along each axis. Only bricks of
/// 8 x 8 x 8 voxels that contain medium are stored. Voxel (i, j, k) of a brick is element i + 8 j + 64 k of
/// the brick's values.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fx::base {

constexpr int kVolumeBrickSide = 8; ///< [voxel] side of a brick
constexpr size_t kVolumeBrickVoxels = 512;
/// [brick] upper bound of the coordinates of bricks; the box of a volume has fewer than 1024 voxels a side.
constexpr int kMaxVolumeBricksPerAxis = 128;
constexpr size_t kMaxVolumeBricks = size_t(1) << 15;
constexpr float kMostVolumeLight = 1e12f;  ///< [cd/m3] and [cd/m2] largest emission
constexpr float kMostVolumeRate = 4096.0f; ///< [1/s] largest rate of emission, of either sign

/// Arrays have kVolumeBrickVoxels elements for each brick. An array other than `extinction` may be empty: the
/// medium does not have the quantity.
struct VoxelVolume
{
    float side = 1.0f;      ///< [m] side of a voxel, > 0
    glm::vec3 origin{0.0f}; ///< [m] center of the voxel (0, 0, 0)
    /// [brick] Coordinates, 1 to kMaxVolumeBricksPerAxis - 1, ascending by z, then y, then x. Voxel (0, 0, 0)
    /// of a brick is voxel 8 times the coordinates of the volume.
    std::vector<glm::ivec3> bricks;
    std::vector<float> extinction;   ///< [1/m] >= 0
    std::vector<float> temperature;  ///< [K] the medium glows as a gray body; empty: it does not glow
    std::vector<glm::vec3> emission; ///< [cd/m3] emitted besides the black body; 0 without extinction
    /// [1/s] change of the logarithm of emission of the medium that moves through the voxel, if it keeps its
    /// extinction; within kMostVolumeRate; empty: unknown. Of use in a sequence
    std::vector<float> emissionRate;
    std::vector<glm::vec3> albedo; ///< [1] 0..1; empty: `evenAlbedo` everywhere
    glm::vec3 evenAlbedo{0.8f};    ///< [1]
    std::vector<glm::vec3>
        velocity; ///< [m/s] of the medium; empty: unknown, and of no use without a sequence

    size_t bytes() const; ///< [byte] size of all arrays
    bool operator==(const VoxelVolume&) const = default;
};

/// Finds bricks by their coordinates in constant time.
class BrickIndex
{
public:
    static constexpr uint32_t kNone = ~0u;

    explicit BrickIndex(const std::vector<glm::ivec3>& bricks);

    /// Index of the brick in the list, or kNone.
    uint32_t find(const glm::ivec3& brick) const
    {
        const glm::ivec3 p = brick - low_;
        if (p.x < 0 || p.y < 0 || p.z < 0 || p.x >= size_.x || p.y >= size_.y || p.z >= size_.z)
            return kNone;
        return table_[size_t(p.x) + size_t(size_.x) * (size_t(p.y) + size_t(size_.y) * size_t(p.z))];
    }
    const glm::ivec3& low() const { return low_; }   ///< [brick] lower corner of the box of all bricks
    const glm::ivec3& size() const { return size_; } ///< [brick] size of the box
    /// One entry for each place of the box, x fastest: the index of the brick, or kNone.
    const std::vector<uint32_t>& table() const { return table_; }

private:
    glm::ivec3 low_{0}, size_{0};
    std::vector<uint32_t> table_;
};

/// The cells of a brick: the cubes between 9 x 9 x 9 voxel centers, of which the last along each axis belong
/// to the next brick. A brick has cells with medium also where only the next brick has voxels with medium.
struct VolumeCells
{
    glm::ivec3 brick{0};       ///< [brick]
    float crossSection = 0.0f; ///< [m2] integral of the interpolated extinction over the cells, > 0
    float temperature = 0.0f;  ///< [K] mean over the cells, weighted with the extinction
    glm::vec3 albedo{0.0f};    ///< [1] mean, likewise
    glm::vec3 emission{0.0f};  ///< [cd/m2] emission over extinction, both integrated; to kMostVolumeLight
};

/// Cells of all bricks with medium, ascending by z, then y, then x. Their cross sections sum to the sum of
/// the extinctions of all voxels times the volume of a voxel.
std::vector<VolumeCells> volumeCells(const VoxelVolume& volume);

} // namespace fx::base
