#include "rendering/voxelization/ball_voxelizer.h"

#include "rendering/optics/color_temperature.h"
#include "rendering/volumes/block_table.h"
#include "rendering/volumes/escape_depth.h"
#include "rendering/voxelization/medium_grid.h"

#include <glm/common.hpp>

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
constexpr int kPaddedVoxels = kPadded * kPadded * kPadded;
constexpr uint32_t kMinBalls = 256;   // of a task
constexpr int kOpacitySteps = 32;     // of the integral over the disc of a ball
constexpr int kOwnSamples = 16;       // of a ball along an axis
constexpr double kWholeShare = 0.999; // from which a ball counts as seen in voxels as it is
constexpr double kLeastDepth = 1e-9;  // of others around a ball

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

/// Escape depths of the voxels of a block and of its border.
using PaddedDepths = std::array<float, kPaddedVoxels>;

/// Weights (2) of one ball, assigned to the voxels of a block and of its border.
class BallWeights
{
public:
    /// @param depths null: all samples are seen alike
    /// @return whether the ball has samples near the block
    bool assign(const VoxelBall& ball, double voxelSize, const glm::ivec3& origin, const PaddedDepths* depths)
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
                for (std::array<double, kPaddedVoxels>* weights : {&weights_, &seen_})
                    std::fill(&(*weights)[at(i, j, low.z)], &(*weights)[at(i, j, high.z)] + 1, 0.0);
        depths_ = depths;
        for (size_t a = 0; a < size_t(x.count); ++a)
            for (size_t b = 0; b < size_t(y.count); ++b)
                assignRow(x, a, y, b, z);
        return true;
    }

    const double* row(int i, int j) const { return &weights_[at(i, j, 0)]; }
    /// The same times the share of the light that leaves the medium. With depths only.
    const double* seenRow(int i, int j) const { return &seen_[at(i, j, 0)]; }

    glm::ivec3 low{0}, high{0}; ///< what is assigned, of the padded block, both included

private:
    using Line = std::array<double, kPadded>;

    static size_t at(int i, int j, int k) { return size_t((i * kPadded + j) * kPadded + k); }

    /// All samples with the numbers a along x and b along y.
    void assignRow(const AxisSamples& x, size_t a, const AxisSamples& y, size_t b, const AxisSamples& z)
    {
        const double inside = 1.0 - x.square[a] - y.square[b];
        if (inside <= 0.0)
            return;
        std::array<double, 4> shares; // (3)
        for (int k = 0; k < 4; ++k)
            shares[size_t(k)] =
                (k / 2 == 1 ? x.above[a] : 1.0 - x.above[a]) * (k % 2 == 1 ? y.above[b] : 1.0 - y.above[b]);
        Line depths{};
        for (int k = 0; depths_ && k < 4; ++k)
            for (int l = low.z; l <= high.z; ++l)
                depths[size_t(l)] +=
                    shares[size_t(k)] * double((*depths_)[at(x.cell[a] + k / 2, y.cell[b] + k % 2, l)]);
        Line line{}, seen{};
        for (size_t c = 0; c < size_t(z.count); ++c) {
            const double q = std::max(inside - z.square[c], 0.0);
            const double weight = q * q; // (2)
            const size_t cell = size_t(z.cell[c]);
            line[cell] += weight * (1.0 - z.above[c]);
            line[cell + 1] += weight * z.above[c];
            if (!depths_)
                continue;
            const double depth = depths[cell] + z.above[c] * (depths[cell + 1] - depths[cell]);
            const double leaving = weight * double(std::exp(-float(depth)));
            seen[cell] += leaving * (1.0 - z.above[c]);
            seen[cell + 1] += leaving * z.above[c];
        }
        for (int k = 0; k < 4; ++k) {
            const size_t first = at(x.cell[a] + k / 2, y.cell[b] + k % 2, 0);
            for (int l = low.z; l <= high.z; ++l)
                weights_[first + size_t(l)] += shares[size_t(k)] * line[size_t(l)];
            for (int l = low.z; depths_ && l <= high.z; ++l)
                seen_[first + size_t(l)] += shares[size_t(k)] * seen[size_t(l)];
        }
    }

    std::array<double, kPaddedVoxels> weights_{}, seen_{};
    const PaddedDepths* depths_ = nullptr;
};

/// [1/m] Density of a ball for a weight of 1. @param norm 1 / N
double densityOf(const VoxelBall& ball, double norm, double voxelSize)
{
    return ball.crossSection * norm / (voxelSize * voxelSize * voxelSize); // (3)
}

/// Of a ball over its disc: formula widened-ball (1) with s = q^2.
double meanOpacity(double depth)
{
    double sum = 0.0;
    for (int i = 0; i < kOpacitySteps; ++i) {
        const double q = (i + 0.5) / kOpacitySteps;
        sum -= 2.0 * q * double(std::expm1(-depth * q * q * q * q * q));
    }
    return sum / kOpacitySteps;
}

/// In the middle of a ball between its voxels, over sigma / h^3.
double ownDensity(const glm::dvec3& center, double radius)
{
    double density = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double above = center[axis] - std::floor(center[axis]);
        double sum = 0.0, weights = 0.0;
        for (int i = 0; i < kOwnSamples; ++i) {
            const double x = (2.0 * i + 1.0) / kOwnSamples - 1.0, place = above + radius * x;
            const double weight = (1.0 - x * x) * (1.0 - x * x) * (1.0 - x * x); // (2) along one axis
            sum += weight * ((1.0 - above) * std::max(1.0 - std::abs(place), 0.0) +
                             above * std::max(1.0 - std::abs(place - 1.0), 0.0));
            weights += weight;
        }
        density *= sum / weights;
    }
    return density;
}

/// Calls add(k, weight, seen) for the voxels of a block.
/// @param seen whether samples are weighted with what leaves the medium
template <class Add>
void forVoxels(const BallWeights& weights, bool seen, const Add& add)
{
    const int firstZ = std::max(weights.low.z, 1), lastZ = std::min(weights.high.z, kBlockSide);
    for (int i = std::max(weights.low.x, 1); i <= std::min(weights.high.x, kBlockSide); ++i)
        for (int j = std::max(weights.low.y, 1); j <= std::min(weights.high.y, kBlockSide); ++j) {
            const double* const from = seen ? weights.seenRow(i, j) : weights.row(i, j);
            const size_t to = size_t(((i - 1) * kBlockSide + j - 1) * kBlockSide);
            for (int k = firstZ; k <= lastZ; ++k)
                add(to + size_t(k - 1), from[k]);
        }
}

/// Sums over the balls of a block.
class BlockSums
{
public:
    /// @param density densityOf() the ball  @param luminance, red [cd/m2] of its light
    void add(const VoxelBall& ball, double density, double luminance, double red, const BallWeights& weights,
             bool hasDepths)
    {
        const std::array<double, kMeans> values{
            density,
            density * ball.temperature,
            density * ball.velocity.x,
            density * ball.velocity.y,
            density * ball.velocity.z,
            density * ball.albedo.x,
            density * ball.albedo.y,
            density * ball.albedo.z,
        };
        for (size_t s = 0; s < kMeans; ++s)
            forVoxels(weights, false, [&](size_t v, double weight) { means_[s][v] += values[s] * weight; });
        const std::array<double, kLights> lights{density, density * luminance, density * red};
        for (size_t s = 0; s < kLights; ++s)
            if (lights[s] > 0.0)
                forVoxels(weights, hasDepths,
                          [&](size_t v, double weight) { lights_[s][v] += lights[s] * weight; });
    }

    void write(VoxelBlock& out) const
    {
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v) {
            const double density = means_[0][v];
            const double share = density > 0.0 ? 1.0 / density : 0.0;
            const double seen = lights_[0][v], light = lights_[1][v], red = lights_[2][v];
            const auto mean = float(means_[1][v] * share);
            out.density[v] = float(density);
            out.flame[v] = float(seen > 0.0 ? density * light / seen : 0.0);
            out.temperature[v] = light > 0.0 ? colorTemperature(float(red / light), mean) : mean;
            out.velocity[v] = {float(means_[2][v] * share), float(means_[3][v] * share),
                               float(means_[4][v] * share)};
            out.albedo[v] = {float(means_[5][v] * share), float(means_[6][v] * share),
                             float(means_[7][v] * share)};
        }
    }

private:
    static constexpr size_t kMeans = 8;  // density, temperature, velocity, albedo
    static constexpr size_t kLights = 3; // density, luminance and red, as they are seen
    std::array<std::array<double, kBlockVoxels>, kMeans> means_{};
    std::array<std::array<double, kBlockVoxels>, kLights> lights_{};
};

/// @param places [block] of all blocks, rising
void gatherDepths(std::span<const glm::ivec3> places, std::span<const float> depths, size_t block,
                  PaddedDepths& out)
{
    std::array<size_t, 27> around;
    for (int k = 0; k < 27; ++k)
        around[size_t(k)] =
            findBlock(places, places[block] + glm::ivec3(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1));
    for (int v = 0; v < kPaddedVoxels; ++v) {
        const glm::ivec3 in = glm::ivec3(v / (kPadded * kPadded), v / kPadded % kPadded, v % kPadded) - 1;
        const glm::ivec3 step(in.x >> 3, in.y >> 3, in.z >> 3);
        const size_t other = around[size_t(9 * (step.x + 1) + 3 * (step.y + 1) + step.z + 1)];
        out[size_t(v)] =
            other == kNoBlock
                ? 0.0f
                : depths[other * size_t(kBlockVoxels) + voxelInBlock(in.x & 7, in.y & 7, in.z & 7)];
    }
}

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

SpreadBall spreadBall(double section, double radius)
{
    const double square = radius * radius, wide = square + 3.0; // (5)
    const double depth = 3.5 * std::numbers::inv_pi * section;  // times the radius squared
    const double spread = wide * meanOpacity(depth / wide);
    SpreadBall ball;
    if (spread > 0.0)
        ball.share = std::min(square * meanOpacity(depth / square) / spread, 1.0); // (6)
    ball.depth = depth / wide;
    return ball;
}

BallVoxelizer::BallVoxelizer(std::span<const VoxelBall> balls, const BlockPlan& plan, base::TaskRunner& tasks)
    : balls_(balls), plan_(plan), tasks_(tasks), normalization_(balls.size()), luminance_(balls.size()),
      red_(balls.size())
{
    tasks_.parallelFor(uint32_t(balls.size()), kMinBalls, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            normalization_[i] = sampleNormalization(balls_[i].radius / plan_.voxelSize());
            luminance_[i] = balls_[i].luminance;
            red_[i] = luminance_[i] * double(blackBodyColor(float(balls_[i].temperature)).x);
        }
    });
}

std::vector<float> BallVoxelizer::densities(std::span<const double> factors) const
{
    std::vector<float> out(plan_.voxels());
    tasks_.parallelFor(uint32_t(plan_.blocks().size()), 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t b = begin; b < end; ++b)
            fillDensity(b, factors, std::span(out).subspan(b * size_t(kBlockVoxels), kBlockVoxels));
    });
    return out;
}

void BallVoxelizer::fillDensity(size_t block, std::span<const double> factors, std::span<float> out) const
{
    const auto weights = std::make_unique<BallWeights>();
    const BlockPlan::Block& own = plan_.blocks()[block];
    std::array<double, kBlockVoxels> sums{};
    for (const uint32_t ball : plan_.balls().subspan(own.first, own.count)) {
        const double factor = factors.empty() ? 1.0 : factors[ball];
        if (factor > 0.0 && weights->assign(balls_[ball], plan_.voxelSize(), own.origin, nullptr)) {
            const double density = factor * densityOf(balls_[ball], normalization_[ball], plan_.voxelSize());
            forVoxels(*weights, false, [&](size_t v, double weight) { sums[v] += density * weight; });
        }
    }
    std::ranges::transform(sums, out.begin(), [](double density) { return float(density); });
}

void BallVoxelizer::findEscapeDepths()
{
    if (std::ranges::none_of(balls_, [](const VoxelBall& ball) { return ball.luminance > 0.0; }))
        return;
    places_.clear();
    for (const BlockPlan::Block& block : plan_.blocks())
        places_.push_back(block.origin / kBlockSide); // multiples of it
    escapeDepths_ =
        escapeDepths({places_, {kBlockSide * kBlockSide, kBlockSide, 1}, densities({}), plan_.voxelSize()});
    dimSmallBalls();
}

void BallVoxelizer::dimSmallBalls()
{
    const double side = plan_.voxelSize();
    std::vector<SpreadBall> spread(balls_.size());
    std::vector<double> lost(balls_.size(), 0.0);
    tasks_.parallelFor(uint32_t(balls_.size()), kMinBalls, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i)
            if (luminance_[i] > 0.0) {
                spread[i] = spreadBall(balls_[i].crossSection / (side * side), balls_[i].radius / side);
                if (spread[i].share < kWholeShare)
                    lost[i] = (1.0 - spread[i].share) * luminance_[i];
            }
    });
    const std::vector<float> sums = densities(lost);
    tasks_.parallelFor(uint32_t(balls_.size()), kMinBalls, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            if (!(lost[i] > 0.0))
                continue;
            const double own = lost[i] * balls_[i].crossSection / (side * side * side) *
                               ownDensity(balls_[i].center / side, balls_[i].radius / side);
            const double all = between(sums, balls_[i].center / side);
            const double others = own > 0.0 ? spread[i].depth * std::max(all / own - 1.0, 0.0) : 0.0;
            const double share = others > kLeastDepth
                                     ? std::expm1(-spread[i].share * others) / std::expm1(-others) // (7)
                                     : spread[i].share;
            luminance_[i] *= share;
            red_[i] *= share;
        }
    });
}

double BallVoxelizer::between(std::span<const float> values, const glm::dvec3& place) const
{
    const glm::dvec3 below = glm::floor(place), above = place - below;
    double sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        const glm::ivec3 corner(k / 4, k / 2 % 2, k % 2), voxel = glm::ivec3(below) + corner;
        const size_t block = findBlock(places_, {voxel.x >> 3, voxel.y >> 3, voxel.z >> 3});
        const glm::dvec3 shares = glm::mix(1.0 - above, above, glm::dvec3(corner));
        if (block != kNoBlock)
            sum += shares.x * shares.y * shares.z *
                   double(values[block * size_t(kBlockVoxels) +
                                 voxelInBlock(voxel.x & 7, voxel.y & 7, voxel.z & 7)]);
    }
    return sum;
}

void BallVoxelizer::fill(size_t first, size_t count, std::vector<VoxelBlock>& out) const
{
    out.resize(count);
    tasks_.parallelFor(uint32_t(count), 1, [&](uint32_t begin, uint32_t end) {
        const auto weights = std::make_unique<BallWeights>();
        const auto depths = std::make_unique<PaddedDepths>();
        for (uint32_t i = begin; i < end; ++i) {
            const BlockPlan::Block& block = plan_.blocks()[first + i];
            const auto list = plan_.balls().subspan(block.first, block.count);
            const bool hasDepths = !escapeDepths_.empty() && std::ranges::any_of(list, [&](uint32_t ball) {
                return balls_[ball].luminance > 0.0;
            });
            if (hasDepths)
                gatherDepths(places_, escapeDepths_, first + i, *depths);
            const auto sums = std::make_unique<BlockSums>();
            for (const uint32_t ball : list)
                if (weights->assign(balls_[ball], plan_.voxelSize(), block.origin,
                                    hasDepths ? depths.get() : nullptr))
                    sums->add(balls_[ball], densityOf(balls_[ball], normalization_[ball], plan_.voxelSize()),
                              luminance_[ball], red_[ball], *weights, hasDepths);
            out[i].origin = block.origin;
            sums->write(out[i]);
        }
    });
}

} // namespace fx::render
