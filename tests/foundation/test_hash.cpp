#include "foundation/math/hash.h"

#include "foundation/math/bits.h"
#include "foundation/math/geometry.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>
#include <set>

using namespace fx::base;

TEST(Hash, everyFlippedBitChangesIt)
{
    std::array<unsigned char, 21> data{};
    std::set<uint64_t> seen{hashBytes(0, data.data(), data.size())};
    for (size_t bit = 0; bit < data.size() * 8; ++bit) {
        data[bit / 8] = static_cast<unsigned char>(1u << (bit % 8));
        seen.insert(hashBytes(0, data.data(), data.size()));
        data[bit / 8] = 0;
    }
    EXPECT_EQ(seen.size(), data.size() * 8 + 1);
}

TEST(Hash, lengthAndOrderMatter)
{
    const std::array<unsigned char, 16> zeros{};
    EXPECT_NE(hashBytes(0, zeros.data(), 8), hashBytes(0, zeros.data(), 9));
    EXPECT_NE(hashBytes(0, zeros.data(), 0), hashBytes(0, zeros.data(), 1));
    EXPECT_NE(hashWord(hashWord(0, 1), 2), hashWord(hashWord(0, 2), 1));
}

TEST(Hash, ofNothingDoesNotAskWhereItLies)
{
    const char byte = 1;
    EXPECT_EQ(hashBytes(7, nullptr, 0), hashBytes(7, &byte, 0));
}

TEST(Hash, flippingOneBitFlipsAboutHalfOfTheResult)
{
    int flips = 0;
    for (int bit = 0; bit < 64; ++bit)
        flips += std::popcount(hashWord(0, 12345) ^ hashWord(0, 12345 ^ (uint64_t(1) << bit)));
    EXPECT_NEAR(flips / 64.0, 32.0, 3.0);
}

TEST(Bits, onlyNumbersAreFinite)
{
    EXPECT_TRUE(isFinite(0.0f));
    EXPECT_TRUE(isFinite(std::numeric_limits<float>::max()));
    EXPECT_FALSE(isFinite(std::numeric_limits<float>::infinity()));
    EXPECT_FALSE(isFinite(std::numeric_limits<float>::quiet_NaN()));
    EXPECT_FALSE(isFinite(-std::numeric_limits<double>::infinity()));
    const double values[] = {1.0, std::numeric_limits<double>::quiet_NaN()};
    EXPECT_TRUE(allFinite(values, 1));
    EXPECT_FALSE(allFinite(values, 2));
}

TEST(Bounds, growAroundBallsAndStartEmpty)
{
    Bounds bounds;
    EXPECT_TRUE(bounds.empty());
    bounds.add({1.0f, 2.0f, 3.0f}, 0.5f);
    bounds.add({-1.0f, 2.0f, 3.0f}, 0.25f);
    EXPECT_FALSE(bounds.empty());
    EXPECT_EQ(bounds.min.x, -1.25f);
    EXPECT_EQ(bounds.max.x, 1.5f);
    EXPECT_EQ(bounds.max.y, 2.5f);
}
