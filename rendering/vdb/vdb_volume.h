/// @file vdb_volume.h
/// Media as the bytes of an OpenVDB file. vdb_reader.h reads.
///
/// The content of the file is created in memory. The content depends only on the arguments. Threads: only one
/// thread at a time may use an object.
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

/// Names and values of the metadata of a file.
using VdbMetadata = std::vector<std::pair<std::string, std::variant<std::string, double, int64_t>>>;

/// The version of the linked OpenVDB, such as "10.0.1"; empty if the library was built without OpenVDB.
std::string vdbVersion();

/// Checks whether the library was built with OpenVDB. @return NotFound if it was built without OpenVDB; the
/// message names the remedy
base::Status checkVdb();

/// An OpenVDB file with the grids `density` [1/m], `temperature` [K], `flame` [cd/m3], `flame_rate` [1/s],
/// `v` [m/s] and `Cd` (albedo) on one lattice, and a grid of points.
class VdbVolume
{
public:
    /// Requires that checkVdb() returns no error.
    /// @param voxelSize [m] side of a voxel, > 0
    explicit VdbVolume(double voxelSize);
    ~VdbVolume();
    VdbVolume(const VdbVolume&) = delete;
    VdbVolume& operator=(const VdbVolume&) = delete;

    /// Adds blocks. No two blocks may have the same origin. Voxels with medium become active.
    void add(std::span<const VoxelBlock> blocks);

    /// Adds the grid `points`: one point at the center of each ball. The attributes of a point are `id`,
    /// `instance`, the velocity `v` [m/s] and the radius `pscale` [m].
    /// @param areMedium whether the balls are medium that no voxel has. Then their points also have
    ///        `section` [m2], `temperature` [K], `luminance` [cd/m2], `Cd` (albedo) and `streak` [m]
    void addPoints(std::span<const VoxelBall> balls, bool areMedium = false);

    /// Number of active voxels.
    uint64_t voxels() const;

    /// Returns the content of the file.
    /// @param half true: values are stored with 16 bits, with a relative error of 2^-11. Grids with values
    ///         above 65504 are stored with 32 bits
    /// @return Internal with the message of OpenVDB, or OutOfMemory
    base::Result<std::string> encode(const VdbMetadata& metadata, bool half) const;

private:
    struct Grids;
    std::unique_ptr<Grids> grids_;
};

} // namespace fx::render
