/// @file volume_preset.h
/// Writes the voxels of imported volumes, the balls beside them, and a preset that draws or plays them.
#pragma once

#include "fxsdk/cli/import/brick_volume.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace fx::cli {

struct BrickReport
{
    size_t bricks = 0;
    double side = 0.0;      ///< [m] of a voxel
    double massError = 0.0; ///< [1] relative, of the voxels as they are in the file
    bool isResampled = false;
    size_t balls = 0; ///< beside the voxels
    std::filesystem::path file;
};

/// How a sequence is played.
struct SequencePlay
{
    uint32_t first = 0; ///< number of the first frame
    uint32_t count = 1;
    double framesPerSecond = 24.0;
    std::string end = "hold"; ///< as in the preset
    uint32_t memory = 512;    ///< [MiB]
};

struct SequenceReport
{
    size_t mostBricks = 0;       ///< of a frame
    uint64_t bytes = 0;          ///< [byte] of all files
    double leastSide = 0.0;      ///< [m] of a voxel, in the frame with the smallest
    double side = 0.0;           ///< [m] of a voxel, in the frame with the largest
    double massError = 0.0;      ///< [1] largest of a frame
    bool hasVelocities = true;   ///< of all frames
    bool isResampled = false;    ///< of a frame
    double anisotropy = 0.0;     ///< [1] mean of all frames
    size_t mostBalls = 0;        ///< beside the voxels, of a frame
    std::filesystem::path files; ///< name with the placeholder of the number
};

/// The grid of a frame. @return an error that names the file
using FrameGrid = std::function<base::Result<render::MediumGrid>(uint32_t number)>;

/// Writes the voxels of all frames, NAME.%04d.fxvolume, and then `preset`, NAME.fx.json, which plays them. If
/// a frame has balls beside the voxels, all frames have a file NAME.%04d.fxballs.
/// @return errors of volumeBytesOf(), and of presets that name the files; Io;
///         TooLarge with the number of the frame up to which there are more than sim::kMaxPlayedBalls balls
base::Result<SequenceReport> writeSequencePreset(const FrameGrid& gridOf, const SequencePlay& play,
                                                 double albedo, const std::filesystem::path& preset);

/// Writes `preset` (*.fx.json) and, beside it, the voxels (*.fxvolume) that it names. Balls beside the voxels
/// are in NAME.0000.fxballs, a sequence of one frame.
/// @return errors of volumeBytesOf(); Io; InvalidArgument for a name with '%' and balls
base::Result<BrickReport> writeVolumePreset(const render::MediumGrid& grid, double albedo,
                                            const std::filesystem::path& preset);

} // namespace fx::cli
