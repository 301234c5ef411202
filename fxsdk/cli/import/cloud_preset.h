/// @file cloud_preset.h
/// Fits balls to an imported volume, and writes them as a preset.
#pragma once

#include "foundation/tasks/task_runner.h"
#include "rendering/voxelization/medium_fit.h"
#include "simulation/cloud/ball_list.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fx::cli {

struct CloudFitReport
{
    size_t balls = 0;
    double massError = 0.0;         ///< [1] relative, of the balls as they are in the file
    std::vector<double> viewErrors; ///< [1] of pictures of opacity from three sides
    double seconds = 0.0;           ///< [s] of the fit
    std::filesystem::path ballFile;
};

/// The balls as a game sees them. A grid of flames gives the light that they emit, and temperatures its
/// color; without flames, balls glow as their temperatures do.
/// @param albedo [1] of grids that have no colors
sim::BallList ballListOf(const render::MediumGrid& grid, const std::vector<render::FitBall>& balls,
                         double albedo);

/// Writes `preset` (*.fx.json) and, beside it, the balls (*.fxballs) that it names.
/// @return InvalidArgument for a grid without medium, Interrupted, Io
base::Result<CloudFitReport> writeCloudPreset(const render::MediumGrid& grid,
                                              const render::FitOptions& options, double albedo,
                                              const std::filesystem::path& preset, base::TaskRunner& tasks,
                                              bool showProgress);

} // namespace fx::cli
