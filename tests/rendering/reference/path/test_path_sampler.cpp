#include "rendering/reference/path/path_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace fx::render {
namespace {

TEST(PathSampler, givesEveryElementaryIntervalOnePairOfAPowerOfTwo)
{
    constexpr uint32_t kLog = 8;
    for (const uint32_t pixel : {0u, 7u, 123456u})
        for (uint32_t across = 0; across <= kLog; ++across) {
            std::set<uint32_t> cells;
            for (uint32_t sample = 0; sample < 1u << kLog; ++sample) {
                PathSampler sampler(11, pixel, sample);
                sampler.pair();
                const auto [x, y] = sampler.pair();
                cells.insert(uint32_t(x * (1u << across)) << 16 | uint32_t(y * (1u << (kLog - across))));
            }
            EXPECT_EQ(cells.size(), 1u << kLog) << "pixel " << pixel << ", " << (1u << across) << " columns";
        }
}

TEST(PathSampler, isUniformOverPixels)
{
    constexpr uint32_t kPixels = 40000;
    constexpr uint32_t kCells = 16;
    std::vector<uint32_t> counts(kCells * kCells);
    for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
        const auto [x, y] = PathSampler(5, pixel, 3).pair();
        ASSERT_TRUE(x >= 0.0 && x < 1.0 && y >= 0.0 && y < 1.0);
        ++counts[uint32_t(x * kCells) * kCells + uint32_t(y * kCells)];
    }
    const double expected = double(kPixels) / double(counts.size());
    double chiSquare = 0.0;
    for (const uint32_t count : counts)
        chiSquare += (count - expected) * (count - expected) / expected;
    EXPECT_LT(chiSquare, 331.0); // 255 degrees of freedom: exceeded with probability 0.001
}

TEST(PathSampler, dimensionsAreNotCorrelated)
{
    constexpr uint32_t kSamples = 1 << 12;
    constexpr int kPairs = 6;
    for (int first = 0; first < kPairs; ++first)
        for (int second = first + 1; second < kPairs; ++second) {
            double product = 0.0;
            for (uint32_t sample = 0; sample < kSamples; ++sample) {
                PathSampler sampler(3, 17, sample);
                std::array<std::array<double, 2>, kPairs> pairs;
                for (auto& pair : pairs)
                    pair = sampler.pair();
                product += (pairs[size_t(first)][0] - 0.5) * (pairs[size_t(second)][0] - 0.5);
            }
            EXPECT_LT(std::abs(product / kSamples) * 12.0, 4.0 / std::sqrt(double(kSamples)))
                << first << ' ' << second;
        }
}

TEST(PathSampler, isAFunctionOfItsArguments)
{
    for (int pair = 0; pair < 70; ++pair) { // stratified ones and those behind
        PathSampler a(9, 4, 2), b(9, 4, 2), otherSample(9, 4, 3), otherPixel(9, 5, 2);
        std::array<double, 2> ofA{}, ofB{}, ofSample{}, ofPixel{};
        for (int i = 0; i <= pair; ++i) {
            ofA = a.pair();
            ofB = b.pair();
            ofSample = otherSample.pair();
            ofPixel = otherPixel.pair();
        }
        EXPECT_EQ(ofA, ofB);
        EXPECT_NE(ofA, ofSample);
        EXPECT_NE(ofA, ofPixel);
        EXPECT_EQ(a.number(), b.number());
    }
}

} // namespace
} // namespace fx::render
