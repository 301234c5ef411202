/// @file ball_voxelizer.h
/// Fills blocks of voxels with balls of medium, with antialiasing. Mass and center of mass are conserved for
/// balls of any size, including balls smaller than a voxel.
#pragma once

#include "foundation/tasks/task_runner.h"
#include "rendering/voxelization/block_plan.h"
#include "rendering/voxelization/voxel_ball.h"
#include "rendering/voxelization/voxel_detail.h"

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
///   t       1      optical depth through the middle of the ball
///   W       1      radius in voxels of a ball that is as wide as the ball in voxels
///   F       1      mean opacity over the disc of a ball, of formula widened-ball
///   u, v    1      depth of the ball in voxels, and of others around it
///   g, G    1      factor of the light of a ball alone, and of one among others
///   L, L_0  cd/m3  light that balls lose, of all of them and of the ball itself
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
///   weight exp(-t(x_a)) of formula escape-depth, of which (3) is the light of the voxel. The rate of the
///   light is the mean of that of the balls, weighted with the light of each.
///   These depths do not know what a ball smaller than a voxel hides of its own light, because its medium is
///   spread. The tent, and the linear interpolation of voxels, each add 1/6 to the second moment of the ball
///   along each axis, R^2 / 9. So the ball is as wide as one with
///       W^2 = R^2 + 3                                                                         (5)
///   and the depth t R^2 / W^2. A ball of depth t gives light with F(t) of its disc, a spread one hence with
///       g = F(t) R^2 / (F(u) W^2),  t = 7 sigma / (2 pi h^2 R^2),  u = t R^2 / W^2            (6)
///   of the light that voxels would give. Where balls that are spread overlap, they hide each other too. With
///   the sum L of (3) for sigma (1 - g) times the emitted light of all balls in place of sigma, between the
///   voxels around the middle of the ball, and the share L_0 of the ball itself in it, others have the depth
///   v, and of v only g v is real
///       v = u (L / L_0 - 1),  G = (1 - exp(-g v)) / (1 - exp(-v))                             (7)
///   G is the factor of the light of the ball: g of one alone, 1 among many.
/// @source    textbook; (3) is the assignment "cloud in cell" of particle-mesh methods
/// @deviation for n R > 32, N is the integral of the kernel, 32 pi/105 (n R)^3, instead of the sum; F by the
///            midpoint rule, within 2e-3; v below 1e-5 u counts as 0. Medium that emits nothing is no part of
///            (7): escape depths know it. (6) and (7) know no detail of balls
/// @valid     R > 0; |c| + R < 2^30
/// @accuracy  mass of one ball within 1e-6 (floats), of the integral instead of (4) 4e-7; center of mass
/// within
///            1e-5 voxel near the origin; the same bits for any number of threads
/// @tests     tests/rendering/voxelization/test_ball_voxelizer.cpp

/// Reciprocal of the sum (4) for a ball with a radius of `radius` voxels.
double sampleNormalization(double radius);

/// What voxels hold of a ball.
struct SpreadBall
{
    double share = 1.0; ///< g of (6)
    double depth = 0.0; ///< u of (6)
};

/// @param section sigma / h^2, > 0  @param radius R, > 0
SpreadBall spreadBall(double section, double radius);

class BlockDetail;

class BallVoxelizer
{
public:
    /// @param balls, plan balls and their plan; both must outlive this object
    BallVoxelizer(std::span<const VoxelBall> balls, const BlockPlan& plan, base::TaskRunner& tasks);

    /// Fills `out` with the blocks [first, first + count) of the plan.
    void fill(size_t first, size_t count, std::vector<VoxelBlock>& out) const;

    /// Multiplies the medium of balls by their detail. Called before the others.
    /// @param detail null: none; must outlive this object
    void setDetail(const VoxelDetail* detail) { detail_ = detail; }

    /// Sets the light of thick voxels to that of their sides that are seen from outside, and that of thick
    /// balls, of which voxels do not show the surface, to what leaves the ball. Without a call of this
    /// function, the light of a voxel is the mean of what the balls emit. Does nothing if no ball emits.
    void findEscapeDepths();

private:
    /// @param factors of the density of each ball; empty: 1. Balls with 0 are left out
    std::vector<float> densities(std::span<const double> factors) const;
    void fillDensity(size_t block, std::span<const double> factors, BlockDetail& detail,
                     std::span<float> out) const;
    void dimSmallBalls();
    double between(std::span<const float> values, const glm::dvec3& place) const;

    std::span<const VoxelBall> balls_;
    const BlockPlan& plan_;
    base::TaskRunner& tasks_;
    const VoxelDetail* detail_ = nullptr;
    std::vector<double> normalization_; ///< sampleNormalization() of each ball
    std::vector<double> luminance_;     ///< [cd/m2] of the light of each ball
    std::vector<double> red_;           ///< [cd/m2] the same of its red
    std::vector<float> escapeDepths_;   ///< of the voxels of all blocks; empty: not found
    std::vector<glm::ivec3> places_;    ///< [block] coordinates of the blocks
};

} // namespace fx::render
