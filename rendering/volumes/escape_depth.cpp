#include "rendering/volumes/escape_depth.h"

#include "rendering/volumes/block_table.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace fx::render {

namespace {

constexpr int kSide = 8;
constexpr size_t kVoxels = 512;
constexpr int kAround = 27; // a block and its neighbors
constexpr double kAxisWeight = 1.0 / 15.0, kCornerWeight = 3.0 / 40.0;

int aroundOf(const glm::ivec3& step)
{
    return step.x + 1 + 3 * (step.y + 1) + 9 * (step.z + 1);
}

class Sweep
{
public:
    /// @param ofWholeVoxels shares (4) instead of those of the centers
    Sweep(const BlockLattice& lattice, bool ofWholeVoxels)
        : lattice_(lattice), ofWholeVoxels_(ofWholeVoxels), around_(lattice.blocks.size()),
          order_(lattice.blocks.size()), depth_(lattice.extinction.size()), seen_(lattice.extinction.size())
    {
        for (size_t b = 0; b < around_.size(); ++b)
            for (int k = 0; k < kAround; ++k)
                around_[b][size_t(k)] = findBlock(
                    lattice.blocks, lattice.blocks[b] + glm::ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
    }

    /// Adds all directions.
    std::vector<float> shares() &&
    {
        for (int a = 0; a < 3; ++a)
            for (const int sign : {-1, 1}) {
                glm::ivec3 d(0);
                d[a] = sign;
                add(d, kAxisWeight);
            }
        for (int k = 0; k < 8; ++k)
            add(glm::ivec3(k & 1, k >> 1 & 1, k >> 2) * 2 - 1, kCornerWeight);
        return std::move(seen_);
    }

private:
    /// @param d each component -1 to 1
    void add(const glm::ivec3& d, double weight)
    {
        std::iota(order_.begin(), order_.end(), 0u);
        const auto alongOf = [&](uint32_t b) {
            const glm::ivec3& p = lattice_.blocks[b];
            return int64_t(d.x) * p.x + int64_t(d.y) * p.y + int64_t(d.z) * p.z;
        };
        std::ranges::sort(order_, std::ranges::greater{}, alongOf); // first those that others look through
        half_ = float(0.5 * lattice_.side * glm::length(glm::dvec3(d)));
        for (const uint32_t block : order_)
            addBlock(block, d);
        for (size_t v = 0; v < depth_.size(); ++v)
            seen_[v] += float(weight) *
                        (ofWholeVoxels_ ? shareOfWhole(v) : std::exp(-std::min(depth_[v], kMostEscapeDepth)));
    }

    /// Voxels that nobody sees are alike, and need no exponential function: most voxels of thick media.
    float shareOfWhole(size_t v) const
    {
        constexpr float kDeepest = 16.0f, kLeast = 1.1e-7f; // exp(-kDeepest)
        const float own = 2.0f * half_ * lattice_.extinction[v], depth = depth_[v] - 0.5f * own;
        if (own == 0.0f || depth > kDeepest)
            return kLeast;
        const float mean = own > 1e-4f ? -std::expm1(-own) / own : 1.0f;
        return mean * std::exp(-std::max(depth, 0.0f));
    }

    void addBlock(uint32_t block, const glm::ivec3& d)
    {
        const glm::ivec3& strides = lattice_.strides;
        const auto placeOf = [](int i, int step) { return step > 0 ? kSide - 1 - i : i; };
        for (int k = 0; k < kSide; ++k)
            for (int j = 0; j < kSide; ++j)
                for (int i = 0; i < kSide; ++i) {
                    const glm::ivec3 own(placeOf(i, d.x), placeOf(j, d.y), placeOf(k, d.z));
                    const glm::ivec3 next = own + d, step(next.x >> 3, next.y >> 3, next.z >> 3);
                    const size_t other = around_[block][size_t(aroundOf(step))];
                    const size_t v = size_t(block) * kVoxels + indexOf(own, strides);
                    float depth = half_ * lattice_.extinction[v];
                    if (other != kNoBlock) {
                        const size_t u = other * kVoxels + indexOf(next - kSide * step, strides);
                        depth += half_ * lattice_.extinction[u] + depth_[u]; // (1)
                    }
                    depth_[v] = depth;
                }
    }

    static size_t indexOf(const glm::ivec3& in, const glm::ivec3& strides)
    {
        return size_t(in.x * strides.x + in.y * strides.y + in.z * strides.z);
    }

    const BlockLattice& lattice_;
    bool ofWholeVoxels_;
    std::vector<std::array<size_t, kAround>> around_;
    std::vector<uint32_t> order_;
    std::vector<float> depth_, seen_;
    float half_ = 0.0f; ///< [m]
};

} // namespace

std::vector<float> escapeDepths(const BlockLattice& lattice)
{
    std::vector<float> depths = Sweep(lattice, false).shares();
    for (float& depth : depths)
        depth = std::max(-std::log(depth), 0.0f); // (2)
    return depths;
}

std::vector<float> seenShares(const BlockLattice& lattice)
{
    return Sweep(lattice, true).shares();
}

} // namespace fx::render
