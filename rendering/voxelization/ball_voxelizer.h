/// @file ball_voxelizer.h
/// Fills blocks of voxels with balls of medium, with antialiasing. Mass and center of mass are conserved for
/// balls of any size, including balls smaller than a voxel.
#pragma once

#include "foundation/tasks/task_runner.h"
#include "rendering/voxelization/block_plan.h"
#include "rendering/voxelization/voxel_ball.h"

#include <span>
#include <vector>

namespace fx::render {

/// @formula ball-voxelization
/// Extinction of a voxel: the quartic kernel of a ball, filtered with a tent as wide as two voxels.
///
/// symbol    unit   meaning
///   h       m      side of a voxel, > 0
///   sigma   m2     extinction cross section of the ball, > 0
///   R       1      radius of the ball in voxels, > 0
///   c       1      center of the ball in voxels
///   n       1      samples along a voxel
///   x_a     1      place of sample a in voxels; a are three whole numbers
///   w_a     1      weight of the sample
///   rho_i   1/m    extinction of the voxel with the index i, three whole numbers
///
/// @derivation
///   The samples are those points inside the ball of a lattice that is symmetric around its center:
///       x_a = c + (a + 1/2) / n,  n = max(2, ceil(4 / R))                                     (1)
///       w_a = (1 - |x_a - c|^2 / R^2)^2, the kernel up to a factor                            (2)
///   With the tent T(t) = max(0, 1 - |t|) along each axis
///       rho_i = sigma / (h^3 N) sum_a w_a T(x_a.x - i.x) T(x_a.y - i.y) T(x_a.z - i.z)        (3)
///       N = sum_a w_a                                                                         (4)
///   The tents of all voxels sum to 1 at any point, so that h^3 sum_i rho_i = sigma. The sum of the tents
///   times i is the point itself, so that the mean of i weighted with rho_i is the mean of the samples,
///   which is c by symmetry.
///   Means of temperature, velocity and albedo are sums over the balls weighted with (3), as is the emitted
///   light where no escape depths are given. Otherwise the samples of a voxel that emits have in addition the
///   weight exp(-t(x_a)) of formula escape-depth, of which (3) is the light of the voxel.
/// @source    textbook; (3) is the assignment "cloud in cell" of particle-mesh methods
/// @deviation for n R > 32, N is the integral of the kernel, 32 pi/105 (n R)^3, instead of the sum
/// @valid     R > 0; |c| + R < 2^30
/// @accuracy  mass of one ball within 1e-6 (floats), of the integral instead of (4) 4e-7; center of mass
/// within
///            1e-5 voxel near the origin; the same bits for any number of threads
/// @tests     tests/rendering/voxelization/test_ball_voxelizer.cpp

/// Reciprocal of the sum (4) for a ball with a radius of `radius` voxels.
double sampleNormalization(double radius);

class BallVoxelizer
{
public:
    /// @param balls, plan balls and their plan; both must outlive this object
    BallVoxelizer(std::span<const VoxelBall> balls, const BlockPlan& plan, base::TaskRunner& tasks);

    /// Fills `out` with the blocks [first, first + count) of the plan.
    void fill(size_t first, size_t count, std::vector<VoxelBlock>& out) const;

    /// Sets the light of thick voxels to that of their sides that are seen from outside. Without a call of
    /// this function, the light of a voxel is the mean of what the balls emit. Does nothing if no ball emits.
    void findEscapeDepths();

private:
    void fillDensity(size_t block, std::span<float> out) const;

    std::span<const VoxelBall> balls_;
    const BlockPlan& plan_;
    base::TaskRunner& tasks_;
    std::vector<double> normalization_; ///< sampleNormalization() of each ball
    std::vector<double> red_;           ///< [cd/m2] of the light of each ball
    std::vector<float> escapeDepths_;   ///< of the voxels of all blocks; empty: not found
    std::vector<glm::ivec3> places_;    ///< [block] coordinates of the blocks
};

} // namespace fx::render
