#include "simulation/verification/case_run.h"

#include "simulation/verification/gas_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fx::sim {
namespace {

std::unique_ptr<GasCase> smallBlast()
{
    CaseSettings settings;
    settings.particles = 10 * 10 * 10;
    settings.time = 0.02;
    return makeGasCase(*findGasCase("sedov"), settings);
}

TEST(CaseRun, theReportIsComplete)
{
    const auto gasCase = smallBlast();
    const auto tasks = base::makeSerialRunner();
    const auto report = runCase<float>(*gasCase, *tasks);
    ASSERT_TRUE(report.ok()) << report.status().message();
    EXPECT_EQ(report->particles, 1000u);
    EXPECT_NEAR(report->seconds, 0.02, 1e-12);
    EXPECT_NEAR(report->energyStart, 1, 0.01);
    EXPECT_GT(report->work.subSteps, 0u);
    EXPECT_GE(report->work.particleSteps, 1000u);
    EXPECT_GT(report->work.pairs, 20 * report->work.particleSteps);
    EXPECT_GT(report->steppingSeconds, 0);
    EXPECT_EQ(report->profile.size(), 1000u);
    EXPECT_TRUE(std::isfinite(report->measures.l1Density));
    EXPECT_GT(report->measures.shockRadius, 0);
}

TEST(CaseRun, theSameRunHasTheSameState)
{
    const auto tasks = base::makeSerialRunner();
    const auto parallel = base::makeTbbRunner(3);
    const auto first = smallBlast();
    const auto second = smallBlast();
    const auto a = runCase<float>(*first, *tasks);
    const auto b = runCase<float>(*second, *parallel);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(a->hash, b->hash);
    const auto third = smallBlast();
    const auto c = runCase<double>(*third, *tasks);
    ASSERT_TRUE(c.ok());
    EXPECT_NE(a->hash, c->hash);
}

TEST(CaseRun, itStopsWhenAskedTo)
{
    const auto gasCase = smallBlast();
    const auto tasks = base::makeSerialRunner();
    CaseWatch watch;
    int asked = 0;
    watch.stop = [&asked] { return ++asked > 20; };
    const auto report = runCase<float>(*gasCase, *tasks, watch);
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.status().code(), base::Code::Interrupted);
    EXPECT_LE(asked, 22);
}

TEST(CaseRun, progressCountsLooks)
{
    const auto gasCase = smallBlast();
    const auto tasks = base::makeSerialRunner();
    CaseWatch watch;
    uint32_t calls = 0;
    watch.progress = [&](uint32_t sample, uint32_t samples) {
        EXPECT_EQ(sample, calls++);
        EXPECT_EQ(samples, gasCase->sampleTimes().size());
    };
    ASSERT_TRUE(runCase<float>(*gasCase, *tasks, watch).ok());
    EXPECT_EQ(calls, gasCase->sampleTimes().size());
}

TEST(CaseRun, conservationIsAmongTheLimitsWhereNoWallTakesMomentum)
{
    const auto tasks = base::makeSerialRunner();
    const auto has = [](const CaseReport& report, const std::string& name) {
        return std::any_of(report.measures.limits.begin(), report.measures.limits.end(),
                           [&](const CaseLimit& limit) { return limit.name == name; });
    };
    const auto blast = smallBlast();
    const auto free = runCase<float>(*blast, *tasks);
    ASSERT_TRUE(free.ok());
    EXPECT_TRUE(has(*free, "energy_drift"));
    EXPECT_TRUE(has(*free, "momentum_drift"));

    CaseSettings settings;
    settings.particles = 12 * 12 * 12;
    settings.time = 2e-5;
    const auto room = makeGasCase(*findGasCase("blast-wave"), settings);
    const auto walled = runCase<float>(*room, *tasks);
    ASSERT_TRUE(walled.ok()) << walled.status().message();
    EXPECT_TRUE(has(*walled, "energy_drift"));
    EXPECT_FALSE(has(*walled, "momentum_drift"));
}

} // namespace
} // namespace fx::sim
