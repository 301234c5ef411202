/// @file ball_weights.h
/// Samples of a ball in the voxels of a block: formula ball-voxelization.
#pragma once

#include "rendering/voxelization/voxel_ball.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace fx::render {

constexpr double kLeastSamples = 2.0;     // along a voxel
constexpr double kSamplesPerRadius = 4.0; // at least
constexpr int kPadded = kBlockSide + 2;   // a block and one voxel more on each side
constexpr int kMaxAlong = 24;             // samples along an axis that reach into one block
constexpr int kPaddedVoxels = kPadded * kPadded * kPadded;

inline double samplesAlongVoxel(double radius)
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
inline double densityOf(const VoxelBall& ball, double norm, double voxelSize)
{
    return ball.crossSection * norm / (voxelSize * voxelSize * voxelSize); // (3)
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

} // namespace fx::render
