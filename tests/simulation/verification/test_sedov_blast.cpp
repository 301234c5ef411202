#include "simulation/verification/sedov_blast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fx::sim {
namespace {

constexpr double kTime = 0.05;

TEST(SedovBlast, theConstantOfTheRadiusIsThePublishedOne)
{
    EXPECT_NEAR(SedovBlast(5.0 / 3.0, 1, 1).xi0(), 1.1517, 1e-4);
    EXPECT_NEAR(SedovBlast(1.4, 1, 1).xi0(), 1.0328, 1e-4);
}

TEST(SedovBlast, behindTheShockTheGasIsAsBehindAnyStrongShock)
{
    for (double gamma : {1.2, 1.4, 5.0 / 3.0}) {
        const SedovBlast blast(gamma, 2, 3);
        const FlowState state = blast.behindShock(kTime);
        const double speed = blast.shockSpeed(kTime);
        EXPECT_NEAR(state.density, 3 * (gamma + 1) / (gamma - 1), 1e-10);
        EXPECT_NEAR(state.velocity, 2 / (gamma + 1) * speed, 1e-10 * speed);
        EXPECT_NEAR(state.pressure, 2 / (gamma + 1) * 3 * speed * speed, 1e-10 * speed * speed);
    }
}

TEST(SedovBlast, theSphereHoldsItsMassAndItsEnergy)
{
    for (double gamma : {1.4, 5.0 / 3.0}) {
        const SedovBlast blast(gamma, 2, 3);
        const double radius = blast.shockRadius(kTime);
        double mass = 0;
        double energy = 0;
        const int count = 100'000;
        for (int i = 0; i < count; ++i) {
            const double r = radius * (i + 0.5) / count;
            const FlowState s = blast.at(r, kTime);
            const double shell = 4 * std::numbers::pi * r * r * radius / count;
            mass += s.density * shell;
            energy += (s.pressure / (gamma - 1) + 0.5 * s.density * s.velocity * s.velocity) * shell;
        }
        EXPECT_NEAR(mass, 3 * 4 * std::numbers::pi / 3 * std::pow(radius, 3), 1e-4 * mass);
        EXPECT_NEAR(energy, 2, 1e-4);
    }
}

TEST(SedovBlast, theFlowObeysTheEquationsOfMotion)
{
    // Continuity, momentum and entropy by central differences in r and t.
    const double gamma = 5.0 / 3.0;
    const SedovBlast blast(gamma, 1, 1);
    const double dr = 1e-3;
    const double dt = 1e-4;
    for (double r : {0.15, 0.2, 0.25, 0.3}) {
        const FlowState s = blast.at(r, kTime);
        const FlowState in = blast.at(r - dr, kTime);
        const FlowState out = blast.at(r + dr, kTime);
        const FlowState old = blast.at(r, kTime - dt);
        const FlowState next = blast.at(r, kTime + dt);
        const auto flux = [](const FlowState& f, double x) { return x * x * f.density * f.velocity; };
        const double massRate = (next.density - old.density) / (2 * dt);
        const double massFlow = (flux(out, r + dr) - flux(in, r - dr)) / (2 * dr * r * r);
        EXPECT_NEAR(massRate + massFlow, 0, 5e-3 * std::abs(massRate));
        const double acceleration =
            (next.velocity - old.velocity) / (2 * dt) + s.velocity * (out.velocity - in.velocity) / (2 * dr);
        const double push = -(out.pressure - in.pressure) / (2 * dr) / s.density;
        EXPECT_NEAR(acceleration, push, 5e-3 * std::abs(push) + 1e-2);
        const auto entropy = [&](const FlowState& f) { return f.pressure / std::pow(f.density, gamma); };
        const double entropyRate = (entropy(next) - entropy(old)) / (2 * dt);
        const double entropyFlow = s.velocity * (entropy(out) - entropy(in)) / (2 * dr);
        EXPECT_NEAR(entropyRate + entropyFlow, 0, 5e-3 * std::abs(entropyRate));
    }
}

TEST(SedovBlast, theCenterIsEmptyAndUnderPressure)
{
    const SedovBlast blast(5.0 / 3.0, 1, 1);
    EXPECT_EQ(blast.at(0, kTime).density, 0);
    const double inner = blast.at(0.01, kTime).pressure;
    EXPECT_NEAR(blast.at(0, kTime).pressure, inner, 1e-6 * inner);
    EXPECT_GT(inner, 0.25 * blast.behindShock(kTime).pressure);
}

TEST(SedovBlast, aheadOfTheShockNothingHasHappened)
{
    const SedovBlast blast(5.0 / 3.0, 1, 1);
    const FlowState state = blast.at(blast.shockRadius(kTime) * 1.000001, kTime);
    EXPECT_EQ(state.density, 1);
    EXPECT_EQ(state.velocity, 0);
    EXPECT_EQ(state.pressure, 0);
}

} // namespace
} // namespace fx::sim
