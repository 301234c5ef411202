#include "simulation/verification/gas_cases.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::sim {
namespace {

std::unique_ptr<GasCase> makeCase(const char* name, uint32_t particles)
{
    CaseSettings settings;
    settings.particles = particles;
    return makeGasCase(*findGasCase(name), settings);
}

double massOf(const GasCase& gasCase)
{
    double mass = 0;
    for (const GasParticle& particle : gasCase.particles())
        mass += particle.mass;
    return mass;
}

TEST(GasCases, allAreFoundByNameAndAcceptedByTheDynamics)
{
    for (const GasCaseEntry& entry : gasCases()) {
        CaseSettings settings;
        settings.particles = 4000;
        const auto gasCase = makeGasCase(entry, settings);
        EXPECT_EQ(findGasCase(entry.name), &entry);
        EXPECT_TRUE(checkGasDynamicsDef(gasCase->dynamics()).ok()) << entry.name;
        GasDynamics<double> gas(gasCase->dynamics(), std::pmr::get_default_resource());
        EXPECT_TRUE(gas.add(gasCase->particles()).ok()) << entry.name;
        EXPECT_FALSE(gasCase->sampleTimes().empty());
    }
    EXPECT_EQ(findGasCase("sedv"), nullptr);
}

TEST(GasCases, theBlastIsInThirtyTwoParticlesAroundTheMiddle)
{
    const auto gasCase = makeCase("sedov", 16 * 16 * 16);
    ASSERT_EQ(gasCase->particles().size(), 4096u);
    EXPECT_NEAR(massOf(*gasCase), 1, 1e-12);
    int hot = 0;
    double energy = 0;
    glm::dvec3 center(0);
    for (const GasParticle& particle : gasCase->particles()) {
        energy += particle.mass * particle.energy;
        if (particle.energy > 1) {
            ++hot;
            center += particle.position;
        }
    }
    EXPECT_EQ(hot, 32);
    EXPECT_NEAR(energy, 1 + 1e-6 / (2.0 / 3.0), 1e-9);
    EXPECT_LT(glm::length(center), 1e-12);
}

TEST(GasCases, theTubeHasEightTimesTheDensityOnOneSide)
{
    const auto gasCase = makeCase("sod", 20'000);
    const glm::dvec3 size = gasCase->dynamics().domain.high - gasCase->dynamics().domain.low;
    EXPECT_NEAR(massOf(*gasCase), 0.5 * 1.125 * size.x * size.y * size.z, 1e-12);
    const double mass = gasCase->particles().front().mass;
    for (const GasParticle& particle : gasCase->particles())
        EXPECT_EQ(particle.mass, mass);
    const double support = std::cbrt(3 * 58 * mass / (4 * std::numbers::pi * 0.125));
    EXPECT_GT(size.y, 2 * support);
}

TEST(GasCases, theFallingSphereHasUnitDensity)
{
    const auto gasCase = makeCase("noh", 20'000);
    EXPECT_NEAR(massOf(*gasCase), 4 * std::numbers::pi / 3, 0.02);
    for (const GasParticle& particle : gasCase->particles())
        EXPECT_NEAR(glm::length(particle.velocity), 1, 1e-12);
}

TEST(GasCases, theCloudHoldsMassAsTheSquareOfTheRadius)
{
    const auto gasCase = makeCase("evrard", 20'000);
    EXPECT_NEAR(massOf(*gasCase), 1, 1e-12);
    double inner = 0;
    for (const GasParticle& particle : gasCase->particles())
        inner += glm::length(particle.position) < 0.5 ? particle.mass : 0;
    EXPECT_NEAR(inner, 0.25, 0.01);
}

TEST(GasCases, theChargeHasItsMassAndItsEnergy)
{
    const auto gasCase = makeCase("blast-wave", 36 * 36 * 36);
    double chargeMass = 0;
    double chargeEnergy = 0;
    for (const GasParticle& particle : gasCase->particles()) {
        if (particle.energy > 1e6) {
            chargeMass += particle.mass;
            chargeEnergy += particle.mass * particle.energy;
        }
    }
    EXPECT_NEAR(chargeEnergy, 4.184e6 / 8, 1);
    EXPECT_NEAR(chargeMass, 1.0 / 8, 0.01);
}

TEST(GasCases, theSettingsOfTheUserReachTheDynamics)
{
    CaseSettings settings;
    settings.particles = 4096;
    settings.gamma = 1.4;
    settings.time = 0.01;
    settings.rules.neighbors = 80;
    settings.rules.courant = 0.1;
    settings.rules.steps = StepScheme::Global;
    const auto gasCase = makeGasCase(*findGasCase("sedov"), settings);
    EXPECT_EQ(gasCase->dynamics().state.gamma, 1.4);
    EXPECT_EQ(gasCase->dynamics().neighbors, 80);
    EXPECT_EQ(gasCase->dynamics().courant, 0.1);
    EXPECT_EQ(gasCase->dynamics().steps, StepScheme::Global);
    EXPECT_EQ(gasCase->sampleTimes().back(), 0.01);
}

} // namespace
} // namespace fx::sim
