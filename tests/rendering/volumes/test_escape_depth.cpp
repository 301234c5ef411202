// Escape depths of media in blocks, against sums by hand.
#include "rendering/volumes/escape_depth.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <cmath>

using namespace fx;

namespace {

constexpr double kSide = 0.1; // [m]

/// Blocks of an even medium.
std::vector<float> evenDepths(const std::vector<glm::ivec3>& blocks, float extinction)
{
    const std::vector<float> values(512 * blocks.size(), extinction);
    return render::escapeDepths({blocks, {1, 8, 64}, values, kSide});
}

/// By the formula, of a voxel in a single even block that ends half a step behind its last voxels.
double depthInBlock(const glm::ivec3& voxel, double extinction)
{
    double seen = 0.0;
    const auto add = [&](const glm::ivec3& d, double weight) {
        int steps = 0;
        for (glm::ivec3 at = voxel + d; at == glm::clamp(at, glm::ivec3(0), glm::ivec3(7)); at += d)
            ++steps;
        const double length = kSide * std::sqrt(double(d.x * d.x + d.y * d.y + d.z * d.z));
        seen += weight * std::exp(-(steps + 0.5) * length * extinction);
    };
    for (const int sign : {-1, 1}) {
        add({sign, 0, 0}, 1.0 / 15.0);
        add({0, sign, 0}, 1.0 / 15.0);
        add({0, 0, sign}, 1.0 / 15.0);
    }
    for (int k = 0; k < 8; ++k)
        add(glm::ivec3(k & 1, k >> 1 & 1, k >> 2) * 2 - 1, 3.0 / 40.0);
    return -std::log(seen);
}

TEST(EscapeDepth, inAnEvenBlockItIsTheMeanOverDirections)
{
    for (const float extinction : {0.0f, 0.2f, 5.0f, 40.0f}) {
        const std::vector<float> depths = evenDepths({{3, -2, 1}}, extinction);
        for (size_t v = 0; v < 512; ++v)
            EXPECT_NEAR(depths[v],
                        depthInBlock({int(v % 8), int(v / 8 % 8), int(v / 64)}, double(extinction)),
                        1e-4 * (1.0 + double(depths[v])));
    }
}

TEST(EscapeDepth, blocksSideBySideHideEachOther)
{
    std::vector<glm::ivec3> blocks;
    for (int b = 0; b < 27; ++b)
        blocks.emplace_back(b / 9 - 1, b / 3 % 3 - 1, b % 3 - 1); // rising
    const std::vector<float> depths = evenDepths(blocks, 10.0f);
    size_t middle = 0;
    while (blocks[middle] != glm::ivec3(0))
        ++middle;
    // from the voxel (3, 3, 3) of the block in the middle the way ends 11.5 voxels away along -x, -y, -z, and
    // 12.5 voxels along x, y, z; ways to the corners are longer
    const auto facesAt = [](double a, double b) { return -std::log(0.2 * (std::exp(-a) + std::exp(-b))); };
    EXPECT_NEAR(depths[512 * middle + 3 + 24 + 192], facesAt(11.5, 12.5), 0.2);
    EXPECT_NEAR(evenDepths({{0, 0, 0}}, 10.0f)[3 + 24 + 192], facesAt(3.5, 4.5), 0.2);
}

TEST(EscapeDepth, theOrderOfVoxelsDoesNotMatter)
{
    const std::vector<glm::ivec3> blocks{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    std::vector<float> first(3 * 512), second(3 * 512);
    const auto other = [](size_t v) { return v / 512 * 512 + v % 8 * 64 + v / 8 % 8 * 8 + v / 64 % 8; };
    for (size_t v = 0; v < first.size(); ++v)
        second[other(v)] = first[v] = float(v * 37 % 101);
    const auto a = render::escapeDepths({blocks, {1, 8, 64}, first, kSide});
    const auto b = render::escapeDepths({blocks, {64, 8, 1}, second, kSide});
    for (size_t v = 0; v < first.size(); ++v)
        EXPECT_EQ(a[v], b[other(v)]);
}

TEST(EscapeDepth, itEndsWhereNothingIsSeen)
{
    for (const float depth : evenDepths({{0, 0, 0}}, 1e9f)) {
        EXPECT_LE(depth, render::kMostEscapeDepth + 1e-3f);
        EXPECT_GE(depth, render::kMostEscapeDepth - 1e-3f);
    }
}

} // namespace
