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

/// As written on the command line.
struct ExportArguments
{
    std::string input;
    std::string output;
    std::string frames; ///< "A:B", empty for the default
    std::string quality = "high";
    double framesPerSecond = 30.0;
    std::optional<double> time;      ///< [s] none: the preset's preview's, or half a second
    std::optional<double> voxelSize; ///< [m] none: as `voxels` allows
    std::optional<uint64_t> voxels;  ///< at most, of a frame
    std::optional<uint64_t> seed;
    bool half = false;
    bool points = false;
    bool json = false;
};

void addExportOptions(CLI::App& command, ExportArguments& arguments);

/// What is exported, when, and where it goes.
struct ExportPlan
{
    using Frame = NumberedFrame;
    NumberedFile output;
    std::vector<Frame> frames;
    bool hasDefaultTime = false; ///< of one file; no option names a time
    uint64_t maxVoxels = 0;
};

/// @return InvalidArgument with the remedy
base::Result<ExportPlan> planExport(const ExportArguments& arguments);

} // namespace fx::cli
