#include "simulation/combustion/fire_share.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx::sim;

namespace {

constexpr GlowRange kSoot{800.0f, 1200.0f};

} // namespace

TEST(FireShare, isNothingInTheColdAndEverythingInTheHeat)
{
    EXPECT_EQ(fireShareOf(400.0f, kSoot), 0.0f);
    EXPECT_EQ(fireShareOf(800.0f, kSoot), 0.0f);
    EXPECT_EQ(fireShareOf(1000.0f, kSoot), 0.5f);
    EXPECT_EQ(fireShareOf(1200.0f, kSoot), 1.0f);
    EXPECT_EQ(fireShareOf(1600.0f, kSoot), 1.0f);
}

TEST(FireShare, growsWithTheTemperature)
{
    for (float t = 700.0f; t < 1300.0f; t += 10.0f)
        EXPECT_LE(fireShareOf(t, kSoot), fireShareOf(t + 10.0f, kSoot));
}

TEST(FireShare, ofNoNumberIsNothing)
{
    EXPECT_EQ(fireShareOf(std::nanf(""), kSoot), 0.0f);
}
