#include "simulation/combustion/charge_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace fx::sim;

namespace {
double volumeOf(double radius)
{
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}
} // namespace

TEST(ChargePlan, theBallOfGasHoldsExactlyTheHeatOfTheCharge)
{
    for (const Material& m : materials()) {
        const ChargePlan plan = planCharge(m, 5e6);
        EXPECT_NEAR(plan.mass * m.nominalEnergy, 5e6, 1e-6) << m.name;
        EXPECT_NEAR(plan.density * volumeOf(plan.radius), plan.mass, 1e-12 * plan.mass) << m.name;
        EXPECT_NEAR(plan.pressure, plan.density * m.gasConstant * plan.temperature, 1e-9 * plan.pressure)
            << m.name;
        EXPECT_NEAR(plan.fuel, plan.mass * m.heatOfCombustion, 1e-9 * plan.fuel);
        if (plan.heat > 0.0) {
            EXPECT_NEAR(plan.pressure * volumeOf(plan.radius) / (plan.gamma - 1.0), plan.heat,
                        1e-12 * plan.heat)
                << m.name;
        }
        EXPECT_GT(plan.gamma, 1.05) << m.name;
        EXPECT_LT(plan.gamma, 1.45) << m.name;
    }
}

TEST(ChargePlan, lengthsAndTimesGrowAsTheCubeRootOfTheEnergy)
{
    for (const Material& m : materials()) {
        const ChargePlan small = planCharge(m, 1e6);
        const ChargePlan large = planCharge(m, 64e6);
        EXPECT_NEAR(large.radius / small.radius, 4.0, 1e-13) << m.name;
        EXPECT_NEAR(large.fireballDiameter / small.fireballDiameter, 4.0, 1e-13) << m.name;
        EXPECT_NEAR(large.fireballDuration / small.fireballDuration, 4.0, 1e-13) << m.name;
        EXPECT_NEAR(large.mass / small.mass, 64.0, 1e-12) << m.name;
        EXPECT_EQ(large.temperature, small.temperature);
        EXPECT_EQ(large.pressure, small.pressure);
        EXPECT_EQ(large.gamma, small.gamma);
    }
}

TEST(ChargePlan, aKilogramOfTntIsItsEquivalent)
{
    const ChargePlan plan = planCharge(*findMaterial("tnt"), energyOfTnt(1.0));
    EXPECT_DOUBLE_EQ(plan.mass, 1.0);
    EXPECT_DOUBLE_EQ(plan.heat, 4.184e6);
    EXPECT_NEAR((plan.heat + plan.fuel) / 1e6, 14.5, 0.5); // heat of combustion of TNT
    EXPECT_GT(planCharge(*findMaterial("tnt"), energyOfTnt(1.0), 10.0).radius, plan.radius);
    EXPECT_DOUBLE_EQ(planCharge(*findMaterial("tnt"), energyOfTnt(1.0), 10.0).gamma, plan.gamma);
}

TEST(ChargePlan, aPetrolFireballHasTheMeasuredSizeAndDuration)
{
    const Material& petrol = *findMaterial("petrol");
    for (const double mass : {1.0, 100.0, 20000.0}) {
        const ChargePlan plan = planCharge(petrol, mass * petrol.nominalEnergy);
        EXPECT_NEAR(plan.fireballDiameter, 5.8 * std::cbrt(mass), 1e-9);
        EXPECT_NEAR(plan.fireballDuration, 0.45 * std::cbrt(mass), 1e-9);
        EXPECT_EQ(plan.pressure, 101325.0); // nothing is heated before it burns
    }
    const ChargePlan huge = planCharge(petrol, 1e5 * petrol.nominalEnergy);
    EXPECT_NEAR(huge.fireballDuration, 2.6 * std::pow(1e5, 1.0 / 6.0), 1e-9);
}

TEST(ChargePlan, theFireballIsAboutWhatTheGasAndItsAirFillWhenHot)
{
    for (const std::string_view name : {"tnt", "petrol"}) {
        const Material& m = *findMaterial(name);
        const ChargePlan plan = planCharge(m, m.nominalEnergy);
        const double density = 1.204 * 293.15 / 1600.0; // of air as hot as a fireball
        const double filled = (1.0 + m.airNeeded) * plan.mass / density;
        const double diameter = 2.0 * std::cbrt(filled * 3.0 / (4.0 * std::numbers::pi));
        EXPECT_NEAR(plan.fireballDiameter / diameter, 1.0, 0.2) << name;
        EXPECT_LT(2.0 * plan.radius, plan.fireballDiameter) << name;
    }
}

TEST(ChargePlan, nonsenseGivesNoCharge)
{
    const Material& tnt = *findMaterial("tnt");
    for (const double energy :
         {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    {
        EXPECT_EQ(planCharge(tnt, energy).mass, 0.0);
        EXPECT_EQ(planCharge(tnt, energy).radius, 0.0);
    }
    EXPECT_EQ(planCharge(tnt, 1e6, std::numeric_limits<double>::quiet_NaN()).pressure, 101325.0);
    EXPECT_EQ(planCharge(tnt, 1e6, -5.0).pressure, 101325.0);
    EXPECT_EQ(planCharge(tnt, 1e6, 1e9).pressure, 101325.0 * 1e4);
}
