// What the --check options of fx bench measure and ask.
#include "benchmarks/bench/instances/flight_pop.h"
#include "benchmarks/bench/quality/budget_check.h"

#include <gtest/gtest.h>

using namespace fx::cli;

namespace {

std::vector<float> gray(float value)
{
    return std::vector<float>(size_t(4) * 20 * 12, value);
}

} // namespace

TEST(FlightPop, findsAChangeInItsBlockInDisplayValues)
{
    std::vector<float> now = gray(0.0f);
    now[4 * (9 * 20 + 17) + 1] = 1.0f; // green at (17, 9)
    const std::vector<float> changes = blockChanges(now, gray(0.0f), 20, 12);
    ASSERT_EQ(changes.size(), 6u) << "3 x 2 blocks, the last ones cut";
    for (size_t i = 0; i < changes.size(); ++i)
        EXPECT_EQ(changes[i], i == 5 ? 0.5f : 0.0f) << i;
    now = gray(0.0f);
    now[3] = 1.0f;
    EXPECT_EQ(blockChanges(now, gray(0.0f), 20, 12)[0], 0.0f) << "opacity is not seen";
    EXPECT_NEAR(double(blockChanges(gray(1000.0f), gray(500.0f), 20, 12)[0]), 0.0, 2e-3) << "both are white";
}

TEST(FlightPop, tellsTheLargestAndTheOneInAHundred)
{
    FlightPop pop;
    std::vector<float> pops(200, 0.01f), motion(200, 0.2f);
    pops[7] = 0.5f;
    pop.add(pops, motion);
    EXPECT_EQ(pop.largest(), 0.5);
    EXPECT_NEAR(pop.p99(), 0.01, 1e-6);
    EXPECT_NEAR(pop.motionLargest(), 0.2, 1e-6);
    pop.add(std::vector<float>(100'000, 0.0f), std::vector<float>(100'000, 0.0f));
    EXPECT_NEAR(pop.p99(), 0.01, 1e-6) << "where nothing changes nothing counts";
    pop.add(std::vector<float>(10, 0.3f), std::vector<float>(10, 0.2f));
    EXPECT_NEAR(pop.p99(), 0.3, 1e-6);
}

TEST(BudgetCheck, asksForBothBoundsAndForALoadThatIsATrial)
{
    const BudgetShares good{0.03, 0.02}, over{0.2, 0.0}, flickers{0.01, 0.5};
    EXPECT_EQ(findBudgetFault(good, over, flickers), "");
    EXPECT_NE(findBudgetFault({0.051, 0.02}, over, flickers), "");
    EXPECT_NE(findBudgetFault({0.03, 0.031}, over, flickers), "");
    EXPECT_NE(findBudgetFault(good, good, flickers).find("fixed"), std::string::npos);
    EXPECT_NE(findBudgetFault(good, over, good).find("naive"), std::string::npos);
}
