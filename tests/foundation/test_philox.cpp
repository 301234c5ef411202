#include "foundation/random/philox.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx::base;

// Known answers: kat_vectors of the Random123 distribution, philox4x32 with 10 rounds.
TEST(Philox, zeroCounterAndKeyGiveThePublishedWords)
{
    EXPECT_EQ(philox({0, 0, 0, 0}, 0), (Random4{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
}

TEST(Philox, allOnesGiveThePublishedWords)
{
    const uint32_t ones = 0xffffffffu;
    EXPECT_EQ(philox({ones, ones, ones, ones}, ~0ull),
              (Random4{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
}

TEST(Philox, digitsOfPiGiveThePublishedWords)
{
    EXPECT_EQ(philox({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, 0x299f31d0a4093822ull),
              (Random4{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}));
}

TEST(Philox, unitFloatsStayBelowOneAndReachZero)
{
    EXPECT_EQ(toUnitFloat(0), 0.0f);
    EXPECT_LT(toUnitFloat(0xffffffffu), 1.0f);
    EXPECT_EQ(toUnitFloat(0x80000000u), 0.5f);
}

TEST(Philox, unitNumbersHaveTheMeanAndVarianceOfTheUniformDistribution)
{
    double sum = 0;
    double squares = 0;
    const int count = 100000;
    for (int i = 0; i < count; ++i) {
        const double u = double(randomUnit4(11, 3, uint64_t(i), RandomPurpose::Position)[0]);
        sum += u;
        squares += u * u;
    }
    const double mean = sum / count;
    EXPECT_NEAR(mean, 0.5, 5 * 0.2887 / std::sqrt(double(count)));
    EXPECT_NEAR(squares / count - mean * mean, 1.0 / 12.0, 2e-3);
}

TEST(Philox, everyInputChangesTheNumbers)
{
    const auto base = randomUnit4(1, 2, 3, RandomPurpose::Life);
    EXPECT_NE(base, randomUnit4(2, 2, 3, RandomPurpose::Life));
    EXPECT_NE(base, randomUnit4(1, 3, 3, RandomPurpose::Life));
    EXPECT_NE(base, randomUnit4(1, 2, 4, RandomPurpose::Life));
    EXPECT_NE(base, randomUnit4(1, 2, 3, RandomPurpose::Noise));
    EXPECT_NE(base,
              randomUnit4(1, 2, 3 + (uint64_t(1) << 32), RandomPurpose::Life)); // the index's upper half
}
