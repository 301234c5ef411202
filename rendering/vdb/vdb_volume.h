/// @file vdb_volume.h
/// Media as the bytes of an OpenVDB file. Write only.
///
/// The bytes are made in memory, so that the caller can put them in place whole or not at all. They depend on
/// nothing but the arguments. Threads: one at a time for each object.
#pragma once

#include "foundation/result/status.h"
#include "rendering/voxelization/voxel_ball.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace fx::render {

/// Name and value of what a file says about itself.
using VdbMetadata = std::vector<std::pair<std::string, std::variant<std::string, double, int64_t>>>;

/// The version of OpenVDB that is linked, such as "10.0.1"; empty: built without it.
std::string vdbVersion();

/// @return NotFound with the remedy when fx was built without OpenVDB
base::Status checkVdb();

/// Grids `density` [1/m], `temperature` [K], `flame` [cd/m3] and `v` [m/s] on one lattice, and points.
class VdbVolume
{
public:
    /// Requires checkVdb().
    /// @param voxelSize [m] > 0
    explicit VdbVolume(double voxelSize);
    ~VdbVolume();
    VdbVolume(const VdbVolume&) = delete;
    VdbVolume& operator=(const VdbVolume&) = delete;

    /// Adds blocks; each origin once. Voxels with medium become active.
    void add(std::span<const VoxelBlock> blocks);

    /// Adds the grid `points`: a point at the center of each ball with the attributes `id`, `instance`, `v`
    /// [m/s] and `pscale` [m], which is the radius.
    void addPoints(std::span<const VoxelBall> balls);

    /// Number of active voxels.
    uint64_t voxels() const;

    /// The file.
    /// @param half values are stored with 16 bits, relative error 2^-11; a grid with values above 65504 stays
    ///             at 32 bits
    /// @return Internal with the message of OpenVDB, OutOfMemory
    base::Result<std::string> encode(const VdbMetadata& metadata, bool half) const;

private:
    struct Grids;
    std::unique_ptr<Grids> grids_;
};

} // namespace fx::render
