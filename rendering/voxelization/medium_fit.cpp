#include "rendering/voxelization/medium_fit.h"

#include "rendering/volumes/block_table.h"
#include "rendering/voxelization/medium_cells.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {
namespace {

constexpr double kLeastRadius = 1.4;    // [voxel] the sum over voxels is within 5 % of the integral
constexpr double kLargestChange = 1.25; // [1] of a radius in one step
constexpr uint32_t kBallsOfATask = 16, kBlocksOfATask = 4;

/// Sums over the voxels of one ball, weighted with p_ij d_i V.
struct Shares
{
    double mass = 0.0;      ///< [m2] (3)
    glm::dvec3 moment{0.0}; ///< [m3] around the ball's center
    double square = 0.0;    ///< [m4]
    double kernel = 0.0;    ///< [1] S_j
    double temperature = 0.0, luminous = 0.0;
    glm::dvec3 albedo{0.0}, velocity{0.0};
};

class MixtureFit
{
public:
    MixtureFit(const MediumGrid& grid, std::vector<FitBall> balls, base::TaskRunner& tasks)
        : grid_(grid), inverse_(glm::inverse(grid.axes)), volume_(grid.voxelVolume()), tasks_(tasks),
          balls_(std::move(balls)), shares_(balls_.size()), field_(grid.density.size())
    {
        for (int a = 0; a < 3; ++a) {
            // Rows of the inverse: how many voxels along an axis a ball of radius 1 reaches.
            reach_[a] = glm::length(glm::dvec3(inverse_[0][a], inverse_[1][a], inverse_[2][a]));
            shortest_ = std::max(shortest_, glm::length(grid.axes[a]));
        }
    }

    double leastRadius() const { return kLeastRadius * shortest_; }
    std::vector<FitBall>& balls() { return balls_; }

    /// One step: (1) to (5).
    void step()
    {
        findShares(false);
        for (size_t j = 0; j < balls_.size(); ++j) {
            FitBall& ball = balls_[j];
            const Shares& s = shares_[j];
            if (!(s.mass > 0.0) || !(s.kernel > 0.0)) {
                ball.crossSection = 0.0;
                continue;
            }
            ball.crossSection = s.mass / s.kernel; // (4)
            const glm::dvec3 way = s.moment / s.mass;
            const double square = std::max(s.square / s.mass - glm::dot(way, way), 0.0);
            const double radius = std::sqrt(3.0 * square); // (5)
            ball.center += way;
            ball.radius =
                std::max(std::clamp(radius, ball.radius / kLargestChange, ball.radius * kLargestChange),
                         leastRadius());
        }
    }

    /// Takes what the grid has besides extinction, removes balls without mass, and gives the rest `mass`.
    std::vector<FitBall> finish(double mass)
    {
        findShares(true);
        std::vector<FitBall> kept;
        double sum = 0.0;
        for (size_t j = 0; j < balls_.size(); ++j) {
            FitBall ball = balls_[j];
            const Shares& s = shares_[j];
            if (!(ball.crossSection > 0.0) || !(s.mass > 0.0))
                continue;
            ball.temperature = s.temperature / s.mass;
            ball.luminance = s.luminous / s.mass;
            ball.albedo = s.albedo / s.mass;
            ball.velocity = s.velocity / s.mass;
            sum += ball.crossSection;
            kept.push_back(ball);
        }
        for (FitBall& ball : kept)
            ball.crossSection *= mass / sum;
        return kept;
    }

private:
    /// First and last voxel that a ball may reach.
    std::pair<glm::ivec3, glm::ivec3> boxOf(const FitBall& ball) const
    {
        const glm::dvec3 center = inverse_ * (ball.center - grid_.origin);
        const glm::dvec3 reach = reach_ * ball.radius;
        return {glm::ivec3(glm::ceil(center - reach)), glm::ivec3(glm::floor(center + reach))};
    }

    /// Calls `visit` with the kernel, the way from the center, and its square, of voxels of a box that the
    /// ball reaches.
    template <class Visit>
    void forEachVoxel(const FitBall& ball, glm::ivec3 low, glm::ivec3 high, Visit&& visit) const
    {
        const double square = ball.radius * ball.radius;
        const double inverse = 1.0 / square;
        const double peak = 105.0 / (32.0 * std::numbers::pi * square * ball.radius);
        for (int x = low.x; x <= high.x; ++x)
            for (int y = low.y; y <= high.y; ++y) {
                glm::dvec3 way = grid_.place({double(x), double(y), double(low.z)}) - ball.center;
                for (int z = low.z; z <= high.z; ++z, way += grid_.axes[2]) {
                    const double r2 = glm::dot(way, way);
                    const double inside = 1.0 - r2 * inverse;
                    if (inside > 0.0)
                        visit(glm::ivec3(x, y, z), peak * inside * inside, way, r2);
                }
            }
    }

    /// Calls `visit` with the number and the part of the box of each block that the ball reaches.
    template <class Visit>
    void forEachBlock(const FitBall& ball, Visit&& visit) const
    {
        const auto [low, high] = boxOf(ball);
        const glm::ivec3 first = low & ~(kBlockSide - 1);
        for (int x = first.x; x <= high.x; x += kBlockSide)
            for (int y = first.y; y <= high.y; y += kBlockSide)
                for (int z = first.z; z <= high.z; z += kBlockSide) {
                    const glm::ivec3 origin(x, y, z);
                    visit(findBlock(grid_.blocks, origin), origin, glm::max(low, origin),
                          glm::min(high, origin + (kBlockSide - 1)));
                }
    }

    /// (1): each block gathers, in the order of balls.
    void findField()
    {
        std::vector<std::vector<uint32_t>> ballsOf(grid_.blocks.size());
        for (uint32_t j = 0; j < balls_.size(); ++j)
            if (balls_[j].crossSection > 0.0)
                forEachBlock(balls_[j], [&](size_t block, const auto&, const auto&, const auto&) {
                    if (block != kNoBlock)
                        ballsOf[block].push_back(j);
                });
        std::ranges::fill(field_, 0.0f);
        tasks_.parallelFor(uint32_t(grid_.blocks.size()), kBlocksOfATask, [&](uint32_t begin, uint32_t end) {
            for (uint32_t b = begin; b < end; ++b) {
                const glm::ivec3 origin = grid_.blocks[b];
                float* const field = field_.data() + size_t(b) * size_t(kBlockVoxels);
                for (const uint32_t j : ballsOf[b]) {
                    const auto [low, high] = boxOf(balls_[j]);
                    forEachVoxel(balls_[j], glm::max(low, origin), glm::min(high, origin + (kBlockSide - 1)),
                                 [&](const glm::ivec3& voxel, double kernel, const auto&, double) {
                                     const glm::ivec3 at = voxel - origin;
                                     field[voxelInBlock(at.x, at.y, at.z)] +=
                                         float(balls_[j].crossSection * kernel);
                                 });
                }
            }
        });
    }

    void findShares(bool withRest)
    {
        findField();
        tasks_.parallelFor(uint32_t(balls_.size()), kBallsOfATask, [&](uint32_t begin, uint32_t end) {
            for (uint32_t j = begin; j < end; ++j) {
                shares_[j] = {};
                if (balls_[j].crossSection > 0.0)
                    addShares(balls_[j], withRest, shares_[j]);
            }
        });
    }

    void addShares(const FitBall& ball, bool withRest, Shares& io) const
    {
        forEachBlock(ball, [&](size_t block, const glm::ivec3& origin, const glm::ivec3& low,
                               const glm::ivec3& high) {
            forEachVoxel(ball, low, high,
                         [&](const glm::ivec3& voxel, double kernel, const glm::dvec3& way, double r2) {
                             io.kernel += kernel * volume_;
                             if (block == kNoBlock)
                                 return;
                             const glm::ivec3 in = voxel - origin;
                             const size_t at = block * size_t(kBlockVoxels) + voxelInBlock(in.x, in.y, in.z);
                             if (!(field_[at] > 0.0f))
                                 return;
                             const double share = ball.crossSection * kernel / double(field_[at]); // (2)
                             const double mass = share * double(grid_.density[at]) * volume_;
                             io.mass += mass;
                             io.moment += mass * way;
                             io.square += mass * r2;
                             if (withRest)
                                 addRest(at, share, mass, io);
                         });
        });
    }

    void addRest(size_t at, double share, double mass, Shares& io) const
    {
        if (!grid_.temperature.empty())
            io.temperature += mass * double(grid_.temperature[at]);
        if (!grid_.flame.empty())
            io.luminous += share * volume_ * double(grid_.flame[at]);
        if (!grid_.albedo.empty())
            io.albedo += mass * glm::dvec3(grid_.albedo[at]);
        if (!grid_.velocity.empty())
            io.velocity += mass * glm::dvec3(grid_.velocity[at]);
    }

    const MediumGrid& grid_;
    glm::dmat3 inverse_; ///< [voxel/m]
    double volume_;
    double shortest_ = 0.0; ///< [m] longest side of a voxel, over which balls cannot be resolved
    glm::dvec3 reach_{0.0}; ///< [voxel/m]
    base::TaskRunner& tasks_;
    std::vector<FitBall> balls_;
    std::vector<Shares> shares_;
    std::vector<float> field_; ///< [1/m] f
};

} // namespace

std::vector<FitBall> fitBalls(const MediumGrid& grid, const FitOptions& options, base::TaskRunner& tasks,
                              const std::function<bool(uint32_t, uint32_t)>& progress)
{
    const std::vector<MediumCell> cells = options.form == FitForm::Uniform
                                              ? uniformCells(grid, options.count)
                                              : adaptiveCells(grid, options.count);
    std::vector<FitBall> balls(cells.size());
    double mass = 0.0;
    for (size_t j = 0; j < cells.size(); ++j) {
        balls[j].center = cells[j].center;
        balls[j].radius = options.overlap * std::sqrt(3.0 * cells[j].spread);
        balls[j].crossSection = cells[j].mass;
        mass += cells[j].mass;
    }
    if (balls.empty())
        return {};
    MixtureFit fit(grid, std::move(balls), tasks);
    for (FitBall& ball : fit.balls())
        ball.radius = std::max(ball.radius, fit.leastRadius());
    const uint32_t steps = options.form == FitForm::Optimized ? options.iterations : 0;
    for (uint32_t k = 0; k < steps; ++k) {
        if (progress && !progress(k, steps))
            return {};
        fit.step();
    }
    return fit.finish(mass);
}

} // namespace fx::render
