#include "simulation/fragments/fragment_flight.h"

#include "simulation/emitters/emitter_def.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx::sim;

namespace {

constexpr glm::vec3 kGravity{0.0f, -9.81f, 0.0f};
constexpr glm::vec3 kStill{0.0f};

MotionState fly(MotionState state, const glm::vec3& acceleration, float perMeter, float seconds, int steps)
{
    for (int i = 0; i < steps; ++i)
        state = flyStep(state, acceleration, kStill, perMeter, seconds / float(steps));
    return state;
}

float cool(float temperature, const CoolingRates& rates, float seconds, int steps)
{
    for (int i = 0; i < steps; ++i)
        temperature = coolStep(temperature, rates, seconds / float(steps));
    return temperature;
}

/// The same by small midpoint steps of the whole equation, in double.
double quadrature(double T, const CoolingRates& rates, double seconds)
{
    const double air = double(kAirTemperature);
    const auto slope = [&](double t) {
        return -rates.convection * (t - air) - rates.radiation * t * t * t * t;
    };
    constexpr int kSteps = 200000;
    const double dt = seconds / kSteps;
    for (int i = 0; i < kSteps; ++i)
        T += dt * slope(T + 0.5 * dt * slope(T));
    return T;
}

} // namespace

TEST(FragmentFlight, inVacuumItIsAParabolaForAnyStep)
{
    const MotionState thrown{{1, 2, 3}, {4, 20, -3}};
    for (const int steps : {1, 3, 120}) {
        const MotionState got = fly(thrown, kGravity, 0.0f, 2.0f, steps);
        EXPECT_NEAR(got.position.x, 9.0f, 1e-4f);
        EXPECT_NEAR(got.position.y, 2.0f + 40.0f - 0.5f * 9.81f * 4.0f, 1e-4f);
        EXPECT_NEAR(got.position.z, -3.0f, 1e-4f);
        EXPECT_NEAR(got.velocity.y, 20.0f - 9.81f * 2.0f, 1e-4f);
    }
}

TEST(FragmentFlight, itFallsAtTheTerminalVelocityForEver)
{
    const float perMeter = 0.02f;
    const float terminal = std::sqrt(9.81f / perMeter);
    MotionState state{{0, 0, 0}, {0, -terminal, 0}};
    for (const float seconds : {0.001f, 0.0166667f, 1.0f}) {
        state = flyStep(state, kGravity, kStill, perMeter, seconds);
        EXPECT_NEAR(state.velocity.y, -terminal, 1e-5f * terminal) << seconds;
    }
    EXPECT_NEAR(fly({{0, 0, 0}, {0, 0, 0}}, kGravity, perMeter, 60.0f, 3600).velocity.y, -terminal,
                1e-4f * terminal);
    EXPECT_NEAR(fly({{0, 0, 0}, {0, -3.0f * terminal, 0}}, kGravity, perMeter, 60.0f, 60).velocity.y,
                -terminal, 1e-3f * terminal);
}

TEST(FragmentFlight, dragFollowsTheClosedFormToSecondOrder)
{
    const float b = 0.05f;
    const double want = 40.0 / (1.0 + 0.05 * 40.0 * 0.5); // w0 / (1 + b w0 t)
    const double way = std::log(1.0 + 0.05 * 40.0 * 0.5) / 0.05;
    double last = 0;
    for (const int steps : {2, 4, 8, 16}) {
        const MotionState got = fly({{0, 0, 0}, {40, 0, 0}}, {0, 0, 0}, b, 0.5f, steps);
        const double error = std::abs(double(got.velocity.x) - want);
        if (last > 0) {
            EXPECT_LT(error, 0.35 * last) << steps;
        }
        last = error;
    }
    EXPECT_NEAR(fly({{0, 0, 0}, {40, 0, 0}}, {0, 0, 0}, b, 0.5f, 64).position.x, way, 2e-3);
}

TEST(FragmentFlight, noStepTurnsAFragmentBack)
{
    for (const float seconds : {0.01f, 1.0f, 100.0f, 1e6f}) {
        const MotionState got = flyStep({{0, 0, 0}, {300, 0, 0}}, {0, 0, 0}, kStill, 2.0f, seconds);
        EXPECT_GE(got.velocity.x, 0.0f);
        EXPECT_LE(got.velocity.x, 300.0f);
        EXPECT_TRUE(std::isfinite(got.position.x));
    }
}

TEST(FragmentFlight, smallAndLightFragmentsAreBrakedMore)
{
    FragmentMatter steel;
    steel.dragCoefficient = 0.47f;
    // a steel ball of 1 cm: 0.75 * 0.47 * 1.204 / (7850 * 0.01)
    EXPECT_NEAR(dragPerMeter(steel, 0.01f), 0.0054066f, 1e-6f);
    EXPECT_NEAR(dragPerMeter(steel, 0.005f) / dragPerMeter(steel, 0.01f), 2.0f, 1e-5f);
    FragmentMatter wood = steel;
    wood.density = 600.0f;
    EXPECT_GT(dragPerMeter(wood, 0.01f), 13.0f * dragPerMeter(steel, 0.01f));
}

TEST(FragmentFlight, coolingAgreesWithQuadrature)
{
    FragmentMatter steel;
    for (const float size : {0.004f, 0.02f}) {
        const CoolingRates rates = coolingRates(steel, size, 15.0f);
        const double want = quadrature(1600.0, rates, 2.0);
        EXPECT_NEAR(double(cool(1600.0f, rates, 2.0f, 120)), want, 0.05) << size;
        const double coarse = std::abs(double(cool(1600.0f, rates, 2.0f, 4)) - want);
        const double fine = std::abs(double(cool(1600.0f, rates, 2.0f, 8)) - want);
        EXPECT_LT(fine, 0.35 * coarse) << size;
    }
}

TEST(FragmentFlight, eachPartOfTheCoolingIsExactForAnyStep)
{
    const CoolingRates onlyAir{0.8, 0.0};
    const CoolingRates onlyLight{0.0, 2e-10};
    EXPECT_NEAR(cool(1500.0f, onlyAir, 1.0f, 1), 293.15 + (1500.0 - 293.15) * std::exp(-0.8), 1e-3);
    EXPECT_NEAR(cool(1500.0f, onlyAir, 1.0f, 1000), cool(1500.0f, onlyAir, 1.0f, 1), 0.05f);
    EXPECT_NEAR(cool(1500.0f, onlyLight, 1.0f, 1),
                1500.0 / std::cbrt(1.0 + 3.0 * 2e-10 * 1500.0 * 1500.0 * 1500.0), 1e-3);
    EXPECT_NEAR(cool(1500.0f, onlyLight, 1.0f, 1000), cool(1500.0f, onlyLight, 1.0f, 1), 0.05f);
    EXPECT_EQ(coolStep(1500.0f, {5.0, 1e-9}, 1e9f), kAirTemperature);
    EXPECT_EQ(coolStep(250.0f, {5.0, 1e-9}, 1.0f), 250.0f);
}

TEST(FragmentFlight, aSmallSparkCoolsInSecondsAndALargePieceInMinutes)
{
    const FragmentMatter steel;
    EXPECT_LT(cool(1600.0f, coolingRates(steel, 0.001f, 10.0f), 3.0f, 180), 700.0f);
    EXPECT_GT(cool(1600.0f, coolingRates(steel, 0.05f, 10.0f), 3.0f, 180), 1500.0f);
    // still air around a ball: Nu = 2
    const CoolingRates still = coolingRates(steel, 0.01f, 0.0f);
    EXPECT_NEAR(still.convection, 6.0 * 2.0 * 0.0524 / (7850.0 * 490.0 * 1e-4), 1e-6);
}
