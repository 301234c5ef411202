/// Small runs of the cases against limits that follow from those of the full runs.

#include "simulation/verification/case_run.h"
#include "simulation/verification/gas_cases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fx::sim {
namespace {

template <class T = float>
CaseReport report(const char* name, const CaseSettings& settings)
{
    const auto tasks = base::makeTbbRunner(2);
    const auto gasCase = makeGasCase(*findGasCase(name), settings);
    const auto result = runCase<T>(*gasCase, *tasks);
    EXPECT_TRUE(result.ok()) << result.status().message();
    return result.ok() ? *result : CaseReport{};
}

CaseSettings settingsOf(uint32_t particles)
{
    CaseSettings settings;
    settings.particles = particles;
    return settings;
}

double densityErrorOfTube(uint32_t particles, SphKernel kernel)
{
    CaseSettings settings = settingsOf(particles);
    settings.rules.kernel = kernel;
    return report("sod", settings).measures.l1Density;
}

TEST(GasAccuracy, theTubeConvergesAndTheQuarticForceDoesNotPass)
{
    const double coarse = densityErrorOfTube(4'000, SphKernel::WendlandC2);
    const double fine = densityErrorOfTube(8'000, SphKernel::WendlandC2);
    const double gate = 0.03;
    EXPECT_LT(fine, gate);
    EXPECT_LT(fine, 0.85 * coarse);
    EXPECT_GT(densityErrorOfTube(8'000, SphKernel::Quartic), 1.3 * gate);
}

TEST(GasAccuracy, theBlastGrowsAsTheTwoFifthsPowerOfTime)
{
    CaseSettings settings = settingsOf(24 * 24 * 24);
    const CaseReport late = report("sedov", settings);
    settings.time = 0.025;
    const CaseReport early = report("sedov", settings);
    const double exponent = std::log(late.measures.shockRadius / early.measures.shockRadius) /
                            std::log(late.seconds / early.seconds);
    EXPECT_NEAR(exponent, 0.4, 0.05);
    EXPECT_NEAR(late.measures.shockRadius, late.measures.shockRadiusExact,
                0.05 * late.measures.shockRadiusExact);
    EXPECT_LT(late.measures.l1Density, 0.36);
    EXPECT_LT(late.measures.l1Velocity, 0.26);
}

TEST(GasAccuracy, aStepForAllConservesMomentumToRounding)
{
    CaseSettings settings = settingsOf(16 * 16 * 16);
    settings.rules.steps = StepScheme::Global;
    EXPECT_LT(report<double>("sedov", settings).momentumDrift, 1e-12);
    EXPECT_LT(report<float>("sedov", settings).momentumDrift, 1e-5);
}

TEST(GasAccuracy, fallingGasPilesUp)
{
    const CaseReport result = report("noh", settingsOf(12'000));
    // A plateau of few particles cannot be as dense as the exact 64.
    EXPECT_GT(result.measures.more[0].value, 15);
    EXPECT_LT(result.measures.more[0].value, 70);
    EXPECT_LT(std::abs(result.energyDrift), 5e-3);
}

TEST(GasAccuracy, theCloudBouncesWhenTheReferenceDoes)
{
    const CaseReport result = report("evrard", settingsOf(6'000));
    const Measure& bounce = result.measures.more[0];
    EXPECT_NEAR(bounce.value, bounce.expected, 0.07); // early by the time that the smeared shock is ahead
    EXPECT_LT(std::abs(result.energyDrift), 1e-2);
}

} // namespace
} // namespace fx::sim
