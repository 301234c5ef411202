/// @file opacity_view.h
/// Pictures of opacity of a grid and of balls, by parallel rays, to compare them. The integrator of the grid
/// knows nothing of balls.
#pragma once

#include "foundation/tasks/task_runner.h"
#include "rendering/voxelization/medium_fit.h"

#include <span>
#include <vector>

namespace fx::render {

/// Parallel rays through the pixels of a picture.
struct OpacityView
{
    glm::dvec3 corner{0.0};                 ///< [m] center of the first pixel
    glm::dvec3 right{1, 0, 0}, up{0, 1, 0}; ///< [m] to the next pixel, of equal length, perpendicular
    int width = 0, height = 0;

    /// Looks along `direction` at the whole grid.
    /// @param pixels along the longer side
    static OpacityView around(const MediumGrid& grid, const glm::dvec3& direction, int pixels);
};

/// 1 - exp(-tau) of each pixel. tau is the integral of the extinction, trilinear between the centers of
/// voxels, by the midpoint rule with steps of a quarter of the shortest side of a voxel.
std::vector<float> opacityOf(const MediumGrid& grid, const OpacityView& view, base::TaskRunner& tasks);

/// 1 - exp(-tau), with the exact integrals tau = sum of 3.5 a / (pi R^2) (1 - (b/R)^2)^(5/2).
std::vector<float> opacityOf(std::span<const FitBall> balls, const OpacityView& view);

/// Root mean square of the difference over that of `exact`, over pixels where one of them is above 0.001.
double relativeError(std::span<const float> picture, std::span<const float> exact);

/// relativeError() from the front, from the side, and obliquely from above.
std::vector<double> viewErrors(const MediumGrid& grid, std::span<const FitBall> balls, int pixels,
                               base::TaskRunner& tasks);

} // namespace fx::render
