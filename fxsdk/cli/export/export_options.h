/// @file export_options.h
/// The arguments of fx export.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/cli/support/frame_range.h"
#include "fxsdk/cli/support/output_target.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fx::cli {

/// Arguments as they are written on the command line.
struct ExportArguments
{
    std::string input;
    std::string output;
    std::string frames; ///< range "A:B" of frames; empty: the default
    std::string quality = "high";
    double framesPerSecond = 30.0;
    std::optional<double> time;      ///< [s] time of a single file; empty: the time of the preset's preview,
                                     ///< or 0.5 s
    std::optional<double> voxelSize; ///< [m] side of all voxels; empty: the smallest that `voxels` allows
    std::optional<uint64_t> voxels;  ///< maximum number of voxels of a frame; empty: the default
    std::optional<uint64_t> seed;
    /// [voxel] Radius below which balls are points; 0: none. Of the largest voxels of a sequence.
    double ballsBelow = 0.0;
    bool detail = false;
    bool half = false;
    bool points = false;
    bool json = false;
};

void addExportOptions(CLI::App& command, ExportArguments& arguments);

/// Checked arguments: the frames to export and their files.
struct ExportPlan
{
    using Frame = NumberedFrame;
    NumberedFile output;
    std::vector<Frame> frames;
    bool hasDefaultTime = false; ///< true if a single file shows the default time
    uint64_t maxVoxels = 0;
};

/// Converts and checks the arguments. @return InvalidArgument with the remedy
base::Result<ExportPlan> planExport(const ExportArguments& arguments);

} // namespace fx::cli
