#include "rendering/voxelization/ball_voxelizer.h"

#include "rendering/optics/color_temperature.h"
#include "rendering/volumes/block_table.h"
#include "rendering/volumes/escape_depth.h"
#include "rendering/voxelization/ball_weights.h"
#include "rendering/voxelization/block_detail.h"
#include "rendering/voxelization/medium_grid.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

namespace fx::render {
namespace {

constexpr double kSummedSamples = 32.0; // per radius, up to which the weights are summed one by one
constexpr uint32_t kMinBalls = 256;     // of a task
constexpr int kOpacitySteps = 32;       // of the integral over the disc of a ball
constexpr double kReach = 2.0;          // [voxel] from the middle of a ball, of the voxels around it
constexpr double kWholeShare = 0.999;   // from which a ball counts as seen in voxels as it is
constexpr double kLeastOthers = 1e-5;   // of the density of a ball, that of others around it; sums are floats

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

/// (3) between voxels in the middle of a ball, over sigma / h^3.
double ownDensity(const glm::dvec3& center, double radius, double normalization)
{
    const double n = samplesAlongVoxel(radius);
    const int last = int(std::ceil(std::min(radius, kReach) * n));
    std::array<std::vector<double>, 3> tents; // of the two voxels around the middle, by sample
    for (int axis = 0; axis < 3; ++axis) {
        const double above = center[axis] - std::floor(center[axis]);
        for (int a = -last; a < last; ++a) {
            const double place = above + (a + 0.5) / n; // (1)
            tents[size_t(axis)].push_back((1.0 - above) * std::max(1.0 - std::abs(place), 0.0) +
                                          above * std::max(1.0 - std::abs(place - 1.0), 0.0));
        }
    }
    const auto squareOf = [&](int a) { return (a + 0.5) * (a + 0.5) / (n * n * radius * radius); };
    double sum = 0.0;
    for (int x = -last; x < last; ++x)
        for (int y = -last; y < last; ++y) {
            const double tent = tents[0][size_t(x + last)] * tents[1][size_t(y + last)];
            for (int z = -last; z < last && tent > 0.0; ++z) {
                const double q = std::max(1.0 - squareOf(x) - squareOf(y) - squareOf(z), 0.0);
                sum += q * q * tent * tents[2][size_t(z + last)]; // (2)
            }
        }
    return normalization * sum;
}

/// Sums over the balls of a block.
class BlockSums
{
public:
    /// @param density densityOf() the ball  @param luminance, red [cd/m2] of its light
    /// @param lit detail of the ball; may be null
    void add(const VoxelBall& ball, double density, double luminance, double red, const BallWeights& weights,
             bool hasDepths, const DetailedBall* lit)
    {
        const auto shareOf = [lit](size_t v) { return lit ? double(lit->factors[v].share) : 1.0; };
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
        const double rate = ball.luminanceRate;
        for (size_t s = 0; s < kMeans; ++s)
            forVoxels(weights, false, [&](size_t v, double weight) {
                const double hotter = lit && s == 1 ? double(lit->factors[v].temperature) : 1.0;
                means_[s][v] += values[s] * hotter * shareOf(v) * weight;
            });
        const std::array<double, kLights> lights{density, density * luminance, density * red,
                                                 density * luminance * rate};
        if (lit && luminance > 0.0) {
            forVoxels(weights, hasDepths, [&](size_t v, double weight) {
                const auto [now, nowRed] = lit->light(v);
                const double part = density * shareOf(v) * weight;
                lights_[0][v] += part;
                lights_[1][v] += part * luminance * now;
                lights_[2][v] += part * luminance * nowRed;
                lights_[3][v] += part * luminance * now * rate;
            });
            return;
        }
        for (size_t s = 0; s < kLights; ++s)
            if (lights[s] != 0.0)
                forVoxels(weights, hasDepths,
                          [&](size_t v, double weight) { lights_[s][v] += lights[s] * shareOf(v) * weight; });
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
            const double rate = light > 0.0 ? lights_[3][v] / light : 0.0;
            out.flameRate[v] =
                float(std::clamp(rate, -double(base::kMostVolumeRate), double(base::kMostVolumeRate)));
            out.temperature[v] = light > 0.0 ? colorTemperature(float(red / light), mean) : mean;
            out.velocity[v] = {float(means_[2][v] * share), float(means_[3][v] * share),
                               float(means_[4][v] * share)};
            out.albedo[v] = {float(means_[5][v] * share), float(means_[6][v] * share),
                             float(means_[7][v] * share)};
        }
    }

private:
    static constexpr size_t kMeans = 8;  // density, temperature, velocity, albedo
    static constexpr size_t kLights = 4; // density, luminance, red, change of luminance, as they are seen
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
        BlockDetail detail(factors.empty() ? detail_ : nullptr, plan_.voxelSize());
        for (uint32_t b = begin; b < end; ++b)
            fillDensity(b, factors, detail, std::span(out).subspan(b * size_t(kBlockVoxels), kBlockVoxels));
    });
    return out;
}

void BallVoxelizer::fillDensity(size_t block, std::span<const double> factors, BlockDetail& detail,
                                std::span<float> out) const
{
    const auto weights = std::make_unique<BallWeights>();
    const BlockPlan::Block& own = plan_.blocks()[block];
    const auto list = plan_.balls().subspan(own.first, own.count);
    std::array<double, kBlockVoxels> sums{};
    detail.find(own, list, balls_, normalization_);
    for (const uint32_t ball : list) {
        const double factor = factors.empty() ? 1.0 : factors[ball];
        if (factor > 0.0 && weights->assign(balls_[ball], plan_.voxelSize(), own.origin, nullptr)) {
            const double density = factor * densityOf(balls_[ball], normalization_[ball], plan_.voxelSize());
            const DetailedBall* const lit = detail.of(ball, balls_[ball]);
            forVoxels(*weights, false, [&](size_t v, double weight) {
                sums[v] += density * (lit ? double(lit->factors[v].share) : 1.0) * weight;
            });
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
    if (std::ranges::none_of(lost, [](double each) { return each > 0.0; }))
        return;
    const std::vector<float> sums = densities(lost);
    tasks_.parallelFor(uint32_t(balls_.size()), kMinBalls, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            if (!(lost[i] > 0.0))
                continue;
            const glm::dvec3 center = balls_[i].center / side;
            const double own = lost[i] * balls_[i].crossSection / (side * side * side) *
                               ownDensity(center, balls_[i].radius / side, normalization_[i]);
            const double more = own > 0.0 ? between(sums, center) / own - 1.0 : 0.0;
            const double others = spread[i].depth * more;
            const double share = more > kLeastOthers
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
        BlockDetail detail(detail_, plan_.voxelSize());
        for (uint32_t i = begin; i < end; ++i) {
            const BlockPlan::Block& block = plan_.blocks()[first + i];
            const auto list = plan_.balls().subspan(block.first, block.count);
            const bool hasDepths = !escapeDepths_.empty() && std::ranges::any_of(list, [&](uint32_t ball) {
                return balls_[ball].luminance > 0.0;
            });
            if (hasDepths)
                gatherDepths(places_, escapeDepths_, first + i, *depths);
            detail.find(block, list, balls_, normalization_);
            const auto sums = std::make_unique<BlockSums>();
            for (const uint32_t ball : list)
                if (weights->assign(balls_[ball], plan_.voxelSize(), block.origin,
                                    hasDepths ? depths.get() : nullptr))
                    sums->add(balls_[ball], densityOf(balls_[ball], normalization_[ball], plan_.voxelSize()),
                              luminance_[ball], red_[ball], *weights, hasDepths,
                              detail.of(ball, balls_[ball]));
            out[i].origin = block.origin;
            sums->write(out[i]);
        }
    });
}

} // namespace fx::render
