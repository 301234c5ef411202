#include "simulation/sph/gas_optics.h"

#include "simulation/emitters/emitter_def.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx::sim;

TEST(GasCooling, mixingIsTheExactExponentialAndKeepsTheHeat)
{
    const Parcel start{2000.0f, 1.0f};
    const Parcel end = coolParcel(start, 0.7f, 0.0f, 2000.0f, 2.0f);
    const double left = std::exp(-1.4);
    EXPECT_NEAR(double(end.temperature), 293.15 + 1706.85 * left, 1e-2);
    const double heat = double(end.mixing) * (double(end.temperature) - 293.15);
    EXPECT_NEAR(heat, 1706.85, 0.1); // what is lost in temperature is gained in mass
}

TEST(GasCooling, radiationFollowsTheFourthPower)
{
    // Against small explicit steps of dT/dt = -r T0 (T/T0)^4.
    double temperature = 2000.0;
    const double step = 1e-5;
    for (int i = 0; i < 200000; ++i)
        temperature -= step * 0.9 * 2000.0 * std::pow(temperature / 2000.0, 4);
    const Parcel end = coolParcel({2000.0f, 1.0f}, 0.0f, 0.9f, 2000.0f, 2.0f);
    EXPECT_NEAR(double(end.temperature), temperature, 0.05);
    EXPECT_EQ(end.mixing, 1.0f);
}

TEST(GasCooling, manySmallStepsEqualOneLargeOne)
{
    for (const auto& [mixing, radiation] : {std::pair{0.8f, 0.0f}, std::pair{0.0f, 0.8f}}) {
        Parcel small{2400.0f, 1.0f};
        for (int i = 0; i < 600; ++i)
            small = coolParcel(small, mixing, radiation, 2400.0f, 0.005f);
        const Parcel large = coolParcel({2400.0f, 1.0f}, mixing, radiation, 2400.0f, 3.0f);
        EXPECT_NEAR(small.temperature, large.temperature, 0.05f);
        EXPECT_NEAR(small.mixing, large.mixing, 1e-3f * large.mixing);
    }
}

TEST(GasCooling, noRateAndNoStepOvershootsTheAir)
{
    for (const float rate : {0.0f, 1.0f, 1e6f, 1e30f})
        for (const float seconds : {0.0f, 1e-6f, 1.0f, 1e6f}) {
            const Parcel end = coolParcel({2400.0f, 1.0f}, rate, rate, 2400.0f, seconds);
            EXPECT_GE(end.temperature, kAirTemperature);
            EXPECT_LE(end.temperature, 2400.0f);
            EXPECT_TRUE(std::isfinite(end.mixing));
        }
}

TEST(GasOptics, fireTurnsToSmokeAroundTheSootTemperature)
{
    GasDef def;
    EXPECT_EQ(fireShareOf(def, 2400.0f), 1.0f);
    EXPECT_NEAR(fireShareOf(def, def.sootTemperature), 0.5f, 1e-5f);
    EXPECT_EQ(fireShareOf(def, 400.0f), 0.0f);
    for (float t = 300.0f; t < 2400.0f; t += 10.0f)
        ASSERT_LE(fireShareOf(def, t), fireShareOf(def, t + 10.0f));
}

TEST(GasOptics, sootFormsOnceAndSmokeDissolvesOnceItHas)
{
    GasDef def;
    GasStore gas(std::pmr::get_default_resource(), 1);
    gas.count = 1;
    gas.at(gas_column::Temperature)[0] = 2400.0f;
    gas.at(gas_column::Mixing)[0] = 1.0f;
    gas.at(gas_column::Vigor)[0] = 1.0f;
    gas.at(gas_column::Exposure)[0] = 0.5f;
    gas.at(gas_column::Soot)[0] = 0.0f;
    gas.at(gas_column::Presence)[0] = 1.0f;
    float soot = 0;
    float presence = 1;
    for (int i = 0; i < 600; ++i) {
        coolGas(def, gas, 1.0f / 60.0f, 0, 1);
        ASSERT_GE(gas.at(gas_column::Soot)[0], soot);
        ASSERT_LE(gas.at(gas_column::Presence)[0], presence);
        soot = gas.at(gas_column::Soot)[0];
        presence = gas.at(gas_column::Presence)[0];
        if (gas.at(gas_column::Temperature)[0] > 1.6f * def.sootTemperature) {
            ASSERT_EQ(soot, 0.0f);
        }
    }
    EXPECT_EQ(soot, 1.0f);
    EXPECT_LT(presence, 0.5f);
    gas.at(gas_column::Temperature)[0] = 2400.0f; // heated again, it stays soot
    coolGas(def, gas, 1e-3f, 0, 1);
    EXPECT_EQ(gas.at(gas_column::Soot)[0], 1.0f);
}
