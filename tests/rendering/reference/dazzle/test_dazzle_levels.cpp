#include "foundation/random/philox.h"
#include "rendering/reference/dazzle/dazzle_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

using namespace fx;
using namespace fx::render;

std::vector<uint32_t> repeated(std::initializer_list<std::pair<uint32_t, size_t>> runs)
{
    std::vector<uint32_t> levels;
    for (const auto& [level, count] : runs)
        levels.insert(levels.end(), count, level);
    return levels;
}

std::vector<uint32_t> randomLevels(size_t count, uint64_t seed, uint32_t brightest)
{
    std::vector<uint32_t> levels;
    for (size_t i = 0; i < count; ++i) {
        const auto u = base::randomUnit4(seed, 0, i, base::RandomPurpose::Noise);
        levels.push_back(u[0] < 0.02f ? uint32_t(255 + u[1] * float(brightest)) : uint32_t(30 + 170 * u[1]));
    }
    return levels;
}

int64_t overflow(const std::vector<uint32_t>& levels)
{
    int64_t sum = 0;
    for (const uint32_t level : levels)
        sum += level > 255 ? int64_t(level) - 255 : 0;
    return sum;
}

int64_t headroom(const std::vector<uint32_t>& levels)
{
    int64_t sum = 0;
    for (const uint32_t level : levels)
        sum += level < 255 ? 255 - int64_t(level) : 0;
    return sum;
}

/// Sum of what pixels below white gained.
template <class Out>
int64_t gained(const std::vector<uint32_t>& in, const std::vector<Out>& out)
{
    int64_t sum = 0;
    for (size_t i = 0; i < in.size(); ++i)
        sum += in[i] <= 255 ? int64_t(out[i]) - int64_t(in[i]) : 0;
    return sum;
}

} // namespace

TEST(DazzleLevels, dealTheWholeOverflowAndNoMore)
{
    for (const uint32_t brightest : {1u, 40u, 2000u, 90000u})
        for (uint64_t seed = 0; seed < 20; ++seed) {
            const auto in = randomLevels(2000 + 37 * seed, seed, brightest);
            const auto out = dazzleLevels(in, 1.0);
            EXPECT_EQ(gained(in, out), std::min(overflow(in), headroom(in))) << brightest << " " << seed;
            for (size_t i = 0; i < in.size(); ++i)
                ASSERT_GE(uint32_t(out[i]), std::min(in[i], 255u));
        }
}

TEST(DazzleLevels, giveEachPixelItsShareWithinTwoLevels)
{
    const auto in = randomLevels(20000, 5, 3000);
    const double share = double(overflow(in)) / double(headroom(in));
    ASSERT_LT(share, 1.0);
    const auto out = dazzleLevels(in, 1.0);
    for (size_t i = 0; i < in.size(); ++i) {
        if (in[i] >= 255)
            continue;
        ASSERT_LT(std::abs(double(out[i]) - in[i] - share * (255.0 - in[i])), 2.0);
    }
}

TEST(DazzleLevels, doNotDarkenWhereThePublishedCodeDoes)
{
    const auto in = repeated({{200, 140000}, {50, 3990}, {9255, 10}});
    const auto printed = dazzleLevelsAsPrinted(in);
    EXPECT_EQ(printed[0], 201);
    EXPECT_EQ(printed[140000], 38); // the fault
    const auto out = dazzleLevels(in, 1.0);
    EXPECT_EQ(*std::min_element(out.begin() + 140000, out.begin() + 143990), 52);
    EXPECT_EQ(gained(in, out), 90000);
}

TEST(DazzleLevels, doNotCreateLightWhereThePublishedCodeDoes)
{
    const auto in = repeated({{100, 143990}, {8000, 10}});
    EXPECT_GT(double(gained(in, dazzleLevelsAsPrinted(in))), 1.5 * double(overflow(in))); // the fault
    EXPECT_EQ(gained(in, dazzleLevels(in, 1.0)), overflow(in));
}

TEST(DazzleLevels, spreadARestEvenlyOverThePicture)
{
    const auto in = repeated({{100, 1000}, {255 + 250, 1}});
    const auto out = dazzleLevels(in, 1.0);
    for (size_t quarter = 0; quarter < 4; ++quarter) {
        const auto begin = out.begin() + ptrdiff_t(250 * quarter);
        EXPECT_NEAR(double(std::accumulate(begin, begin + 250, 0)), 250 * 100.25, 1.0);
    }
}

TEST(DazzleLevels, sumBeyond32BitsAndFillThePictureWhenThereIsMoreThanRoom)
{
    const auto in = repeated({{0, 10}, {4000000000u, 5}});
    EXPECT_EQ(dazzleLevels(in, 1.0), std::vector<uint8_t>(15, 255));
    const auto half = repeated({{0, 300000}, {20000255, 2}}); // 4e7: times 255 is more than 2^31
    EXPECT_EQ(gained(half, dazzleLevels(half, 1.0)), 40000000);
}

TEST(DazzleLevels, dealWhatTheSensorMakesOfTheOverflow)
{
    const auto in = repeated({{0, 1000}, {1255, 100}});
    EXPECT_EQ(gained(in, dazzleLevels(in, 0.0)), 0);
    EXPECT_EQ(gained(in, dazzleLevels(in, 0.25)), 25000);
    EXPECT_EQ(gained(in, dazzleLevels(in, 2.0)), 200000);
    EXPECT_EQ(gained(in, dazzleLevels(in, 1e9)), 255000);
}
