/// @file medium_fit.h
/// Fits balls of medium to a grid.
///
/// @formula ball-mixture-fit
/// Balls whose sum of extinctions is near to that of a grid, by the method of expectation and maximization
/// for mixtures.
///
/// symbol      unit   meaning
///   x_i, V    m, m3  center of voxel i, and volume of a voxel
///   d_i       1/m    extinction of the grid at x_i
///   c_j, R_j  m      center and radius of ball j
///   a_j       m2     cross section of ball j
///   K_ij      1/m3   kernel W(|x_i - c_j|; R_j) of the ball, quartic, with integral 1
///   f_i       1/m    extinction of all balls at x_i
///   S_j       1      sum of K_ij V over all voxels of space, near 1
///   p_ij      1      share of the extinction at voxel i that is attributed to ball j
/// @derivation
///   f_i = sum over j of a_j K_ij                                                            (1)
///   p_ij = a_j K_ij / f_i; the shares of a voxel with f_i > 0 sum to 1                      (2)
///   m_j = sum over i of p_ij d_i V; the sum over j of m_j is the mass of the voxels that
///       balls cover                                                                        (3)
///   a_j <- m_j / S_j, c_j <- sum over i of p_ij d_i V x_i / m_j                             (4)
///   r2_j = sum over i of p_ij d_i V |x_i - c_j|^2 / m_j; the kernel has r2 = R^2 / 3, thus
///       R_j <- sqrt(3 r2_j)                                                                (5)
///   Each step increases the likelihood of the grid as a density of points with respect to a; it minimizes
///   the relative entropy between grid and balls. With c and R fixed it is the iteration of Richardson and
///   Lucy. At the end all a_j are multiplied by the same number, so that their sum is the mass of the grid.
/// @source    [DLR77] section 4.3 for mixtures; [LUC74] for the iteration of amplitudes
/// @deviation Kernels are no exponential family: (5) matches moments and does not maximize. Radii stay above
///            those at which the sum over voxels resolves the kernel.
/// @valid     any lattice that is not singular; d_i >= 0
/// @accuracy  mass: rounding of doubles; the picture: `fx accuracy fit`
/// @tests     tests/rendering/voxelization/test_medium_fit.cpp
#pragma once

#include "foundation/tasks/task_runner.h"
#include "rendering/voxelization/medium_grid.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace fx::render {

/// One ball with the quartic kernel, and what the grid has where it is.
struct FitBall
{
    glm::dvec3 center{0.0};    ///< [m]
    double radius = 0.0;       ///< [m] > 0
    double crossSection = 0.0; ///< [m2] > 0
    double temperature = 0.0;  ///< [K]
    double luminance = 0.0;    ///< [cd/m2] emitted per optical depth, from `flame`
    glm::dvec3 albedo{0.0};    ///< [1]
    glm::dvec3 velocity{0.0};  ///< [m/s]
};

/// How balls are placed.
enum class FitForm
{
    Uniform,   ///< one ball in each cell of a lattice of cubes
    Adaptive,  ///< smaller cells where the medium is visible from outside and varies
    Optimized, ///< from there, centers, radii and amplitudes are fitted
};

struct FitOptions
{
    uint32_t count = 10'000; ///< at most
    FitForm form = FitForm::Optimized;
    uint32_t iterations = 24; ///< of Optimized
    double overlap = 1.6;     ///< [1] radius over the square root of three times the second moment of a cell
};

/// @param progress is called with steps done and their number; false stops
/// @return at most `count` balls in a fixed order, the same on any number of threads; their cross sections
/// sum
///         to that of the grid. Empty: the grid has no medium, or `progress` returned false
std::vector<FitBall> fitBalls(const MediumGrid& grid, const FitOptions& options, base::TaskRunner& tasks,
                              const std::function<bool(uint32_t, uint32_t)>& progress = {});

} // namespace fx::render
