#include "rendering/voxelization/ball_voxelizer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

namespace fx::render {
namespace {

constexpr double kLeastSamples = 2.0;     // along a voxel
constexpr double kSamplesPerRadius = 4.0; // at least
constexpr double kSummedSamples = 32.0;   // per radius, up to which the weights are summed one by one
constexpr int kPadded = kBlockSide + 2;   // a block and one voxel more on each side
constexpr int kMaxAlong = 24;             // samples along an axis that reach into one block
constexpr size_t kSums = 9;               // density, temperature, flame, velocity, albedo
constexpr uint32_t kMinBalls = 256;       // of a task

double samplesAlongVoxel(double radius)
{
    return std::max(kLeastSamples, std::ceil(kSamplesPerRadius / radius)); // (1)
}

/// Samples along one axis whose tents reach into a block.
struct AxisSamples
{
    int count = 0;
    std::array<int, kMaxAlong> cell{};      ///< [voxel] below the sample, from the block's padded corner
    std::array<double, kMaxAlong> above{};  ///< [1] share of the voxel above it
    std::array<double, kMaxAlong> square{}; ///< square of the distance from the center over the radius

    AxisSamples(double center, double radius, int32_t origin)
    {
        const double n = samplesAlongVoxel(radius);
        const double last = std::ceil(radius * n) - 1.0;
        const double corner = double(origin) - 1.0;
        const double from = std::max(std::floor((corner - center) * n - 0.5) - 1.0, -last - 1.0);
        const double to = std::min(std::ceil((corner + kPadded - 1 - center) * n - 0.5) + 1.0, last);
        for (double a = from; a <= to && count < kMaxAlong; a += 1.0) {
            const double offset = (a + 0.5) / n;
            const double place = center + offset; // (1)
            const double below = std::floor(place);
            const double local = below - corner;
            if (local < 0.0 || local > double(kPadded - 2) || std::abs(offset) >= radius)
                continue;
            cell[size_t(count)] = int(local);
            above[size_t(count)] = place - below;
            square[size_t(count)] = offset * offset / (radius * radius);
            ++count;
        }
    }
};

/// Weights (2) of one ball, assigned to the voxels of a block and of its border.
class BallWeights
{
public:
    /// @return whether the ball has samples near the block
    bool assign(const VoxelBall& ball, double voxelSize, const glm::ivec3& origin)
    {
        const double radius = ball.radius / voxelSize;
        const glm::dvec3 center = ball.center / voxelSize;
        const AxisSamples x(center.x, radius, origin.x), y(center.y, radius, origin.y),
            z(center.z, radius, origin.z);
        if (x.count == 0 || y.count == 0 || z.count == 0)
            return false;
        low = {x.cell[0], y.cell[0], z.cell[0]};
        high = {x.cell[size_t(x.count - 1)] + 1, y.cell[size_t(y.count - 1)] + 1,
                z.cell[size_t(z.count - 1)] + 1};
        for (int i = low.x; i <= high.x; ++i)
            for (int j = low.y; j <= high.y; ++j)
                std::fill(row(i, j) + low.z, row(i, j) + high.z + 1, 0.0);
        for (size_t a = 0; a < size_t(x.count); ++a)
            for (size_t b = 0; b < size_t(y.count); ++b)
                assignRow(x, a, y, b, z);
        return true;
    }

    const double* row(int i, int j) const { return &weights_[size_t(i * kPadded + j) * kPadded]; }

    glm::ivec3 low{0}, high{0}; ///< what is assigned, of the padded block, both included

private:
    double* row(int i, int j) { return &weights_[size_t(i * kPadded + j) * kPadded]; }

    /// All samples with the numbers a along x and b along y.
    void assignRow(const AxisSamples& x, size_t a, const AxisSamples& y, size_t b, const AxisSamples& z)
    {
        const double inside = 1.0 - x.square[a] - y.square[b];
        if (inside <= 0.0)
            return;
        std::array<double, kPadded> line{};
        for (size_t c = 0; c < size_t(z.count); ++c) {
            const double q = std::max(inside - z.square[c], 0.0);
            const double weight = q * q; // (2)
            line[size_t(z.cell[c])] += weight * (1.0 - z.above[c]);
            line[size_t(z.cell[c]) + 1] += weight * z.above[c];
        }
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) {
                const double share = (i == 1 ? x.above[a] : 1.0 - x.above[a]) *
                                     (j == 1 ? y.above[b] : 1.0 - y.above[b]); // (3)
                double* const target = row(x.cell[a] + i, y.cell[b] + j);
                for (int k = low.z; k <= high.z; ++k)
                    target[k] += share * line[size_t(k)];
            }
    }

    std::array<double, kPadded * kPadded * kPadded> weights_{};
};

/// Sums over the balls of a block.
class BlockSums
{
public:
    /// @param norm 1 / N
    void add(const VoxelBall& ball, double norm, double voxelSize, const BallWeights& weights)
    {
        const double density = ball.crossSection * norm / (voxelSize * voxelSize * voxelSize); // (3)
        const std::array<double, kSums> values{density,
                                               density * ball.temperature,
                                               density * ball.luminance,
                                               density * ball.velocity.x,
                                               density * ball.velocity.y,
                                               density * ball.velocity.z,
                                               density * ball.albedo.x,
                                               density * ball.albedo.y,
                                               density * ball.albedo.z};
        const int firstZ = std::max(weights.low.z, 1), lastZ = std::min(weights.high.z, kBlockSide);
        for (int i = std::max(weights.low.x, 1); i <= std::min(weights.high.x, kBlockSide); ++i)
            for (int j = std::max(weights.low.y, 1); j <= std::min(weights.high.y, kBlockSide); ++j) {
                const double* const from = weights.row(i, j);
                const size_t to = size_t(((i - 1) * kBlockSide + j - 1) * kBlockSide);
                for (size_t s = 0; s < kSums; ++s)
                    for (int k = firstZ; k <= lastZ; ++k)
                        sums_[s][to + size_t(k - 1)] += values[s] * from[k];
            }
    }

    void write(VoxelBlock& out) const
    {
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v) {
            const double density = sums_[0][v];
            const double share = density > 0.0 ? 1.0 / density : 0.0;
            out.density[v] = float(density);
            out.temperature[v] = float(sums_[1][v] * share);
            out.flame[v] = float(sums_[2][v]);
            out.velocity[v] = {float(sums_[3][v] * share), float(sums_[4][v] * share),
                               float(sums_[5][v] * share)};
            out.albedo[v] = {float(sums_[6][v] * share), float(sums_[7][v] * share),
                             float(sums_[8][v] * share)};
        }
    }

private:
    std::array<std::array<double, kBlockVoxels>, kSums> sums_{};
};

} // namespace

double sampleNormalization(double radius)
{
    const double n = samplesAlongVoxel(radius);
    const double r = radius * n; // in samples
    if (r > kSummedSamples)
        return 105.0 / (32.0 * std::numbers::pi * r * r * r);
    const int last = int(std::ceil(r));
    double octant = 0.0;
    for (int x = 0; x < last; ++x)
        for (int y = 0; y < last; ++y)
            for (int z = 0; z < last; ++z) {
                const double a = x + 0.5, b = y + 0.5, c = z + 0.5;
                const double q = std::max(1.0 - (a * a + b * b + c * c) / (r * r), 0.0);
                octant += q * q; // (4)
            }
    return 1.0 / (8.0 * octant);
}

BallVoxelizer::BallVoxelizer(std::span<const VoxelBall> balls, const BlockPlan& plan, base::TaskRunner& tasks)
    : balls_(balls), plan_(plan), tasks_(tasks), normalization_(balls.size())
{
    tasks_.parallelFor(uint32_t(balls.size()), kMinBalls, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i)
            normalization_[i] = sampleNormalization(balls_[i].radius / plan_.voxelSize());
    });
}

void BallVoxelizer::fill(size_t first, size_t count, std::vector<VoxelBlock>& out) const
{
    out.resize(count);
    tasks_.parallelFor(uint32_t(count), 1, [&](uint32_t begin, uint32_t end) {
        const auto weights = std::make_unique<BallWeights>();
        for (uint32_t i = begin; i < end; ++i) {
            const BlockPlan::Block& block = plan_.blocks()[first + i];
            const auto sums = std::make_unique<BlockSums>();
            for (const uint32_t ball : plan_.balls().subspan(block.first, block.count))
                if (weights->assign(balls_[ball], plan_.voxelSize(), block.origin))
                    sums->add(balls_[ball], normalization_[ball], plan_.voxelSize(), *weights);
            out[i].origin = block.origin;
            sums->write(out[i]);
        }
    });
}

} // namespace fx::render
