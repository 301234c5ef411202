#include "simulation/verification/riemann_problem.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace fx::sim {
namespace {

const FlowState kLeft{1, 0, 1};
const FlowState kRight{0.125, 0, 0.1};

TEST(RiemannProblem, sodsTubeHasItsPublishedStates)
{
    const RiemannProblem monatomic(kLeft, kRight, 5.0 / 3.0);
    EXPECT_NEAR(monatomic.starPressure(), 0.29395, 1e-5);
    EXPECT_NEAR(monatomic.starVelocity(), 0.84119, 1e-5);
    EXPECT_NEAR(monatomic.starDensityLeft(), 0.47969, 1e-5);
    EXPECT_NEAR(monatomic.starDensityRight(), 0.22981, 1e-5);
    EXPECT_NEAR(monatomic.rightWaveSpeed(), 1.84447, 1e-5);

    const RiemannProblem air(kLeft, kRight, 1.4);
    EXPECT_NEAR(air.starPressure(), 0.30313, 1e-5);
    EXPECT_NEAR(air.starVelocity(), 0.92745, 1e-5);
    EXPECT_NEAR(air.starDensityLeft(), 0.42632, 1e-5);
    EXPECT_NEAR(air.starDensityRight(), 0.26557, 1e-5);
    EXPECT_NEAR(air.rightWaveSpeed(), 1.75216, 1e-5);
}

TEST(RiemannProblem, theShockConservesMassMomentumAndEnergy)
{
    const double gamma = 1.4;
    const RiemannProblem problem(kLeft, kRight, gamma);
    const double speed = problem.rightWaveSpeed();
    const FlowState behind = problem.at(speed - 1e-9);
    const FlowState ahead = problem.at(speed + 1e-9);
    const auto flux = [&](const FlowState& s) {
        const double w = s.velocity - speed;
        const double enthalpy = gamma / (gamma - 1) * s.pressure / s.density + 0.5 * w * w;
        return std::array{s.density * w, s.density * w * w + s.pressure, enthalpy};
    };
    for (size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(flux(behind)[k], flux(ahead)[k], 1e-10) << k;
}

TEST(RiemannProblem, theTubeLosesNothing)
{
    // Mass and energy of [-2, 2] at t = 1 are those at t = 0, the momentum is what the pressures at the ends
    // gave.
    const double gamma = 5.0 / 3.0;
    const RiemannProblem problem(kLeft, kRight, gamma);
    double mass = 0;
    double momentum = 0;
    double energy = 0;
    const int count = 400'000;
    for (int i = 0; i < count; ++i) {
        const double x = -2 + (i + 0.5) * 4 / count;
        const FlowState s = problem.at(x);
        mass += s.density * 4 / count;
        momentum += s.density * s.velocity * 4 / count;
        energy += (s.pressure / (gamma - 1) + 0.5 * s.density * s.velocity * s.velocity) * 4 / count;
    }
    EXPECT_NEAR(mass, 2.25, 1e-5);
    EXPECT_NEAR(momentum, 0.9, 1e-5);
    EXPECT_NEAR(energy, 2.2 / (gamma - 1), 1e-5);
}

TEST(RiemannProblem, aMirroredTubeGivesTheMirroredFlow)
{
    const RiemannProblem forward(kLeft, kRight, 1.4);
    const RiemannProblem backward(kRight, kLeft, 1.4);
    for (double s = -1.9; s < 2; s += 0.1) {
        EXPECT_NEAR(forward.at(s).density, backward.at(-s).density, 1e-12);
        EXPECT_NEAR(forward.at(s).velocity, -backward.at(-s).velocity, 1e-12);
        EXPECT_NEAR(forward.at(s).pressure, backward.at(-s).pressure, 1e-12);
    }
}

TEST(RiemannProblem, whoMovesAlongSeesTheSameFlow)
{
    const RiemannProblem resting(kLeft, kRight, 1.4);
    const RiemannProblem moving({1, 3, 1}, {0.125, 3, 0.1}, 1.4);
    for (double s = -1.9; s < 2; s += 0.1) {
        EXPECT_NEAR(moving.at(s + 3).density, resting.at(s).density, 1e-12);
        EXPECT_NEAR(moving.at(s + 3).velocity, resting.at(s).velocity + 3, 1e-12);
    }
}

TEST(RiemannProblem, gasThatCollidesStopsBetweenTwoEqualShocks)
{
    const RiemannProblem problem({1, 2, 1}, {1, -2, 1}, 1.4);
    EXPECT_NEAR(problem.starVelocity(), 0, 1e-12);
    EXPECT_GT(problem.starPressure(), 1);
    EXPECT_NEAR(problem.starDensityLeft(), problem.starDensityRight(), 1e-12);
}

} // namespace
} // namespace fx::sim
