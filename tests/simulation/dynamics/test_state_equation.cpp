#include "simulation/sph/dynamics/state_equation.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx::sim;

namespace {

StateEquation tnt()
{
    StateEquation equation;
    equation.gamma = 1.3;
    equation.jwlA = 371.2e9;
    equation.jwlB = 3.231e9;
    equation.jwlR1 = 4.15;
    equation.jwlR2 = 0.95;
    equation.referenceDensity = 1630;
    return equation;
}

StateEquation water()
{
    StateEquation equation;
    equation.gamma = 4.4;
    equation.stiffness = 6e8;
    return equation;
}

struct Case
{
    StateEquation equation;
    double from, to; ///< [kg/m3]
    double entropy;
};

const Case kCases[] = {
    {StateEquation{}, 0.1, 30.0, 7e4}, {tnt(), 20.0, 2500.0, 4e5}, {water(), 900.0, 1300.0, 1e-4}};

} // namespace

TEST(StateEquation, workAlongAnIsentropeIsTheDifferenceOfEnergies)
{
    for (const Case& c : kCases) {
        // Simpson's rule for the integral of P / rho^2.
        const int steps = 20000;
        const double h = (c.to - c.from) / steps;
        double work = 0;
        for (int k = 0; k <= steps; ++k) {
            const double rho = c.from + k * h;
            const double weight = k == 0 || k == steps ? 1.0 : (k % 2 ? 4.0 : 2.0);
            work += weight * stateAt(c.equation, rho, c.entropy).pressure / (rho * rho);
        }
        work *= h / 3.0;
        const double rise =
            stateAt(c.equation, c.to, c.entropy).energy - stateAt(c.equation, c.from, c.entropy).energy;
        EXPECT_NEAR(work, rise, 1e-8 * std::abs(rise));
    }
}

TEST(StateEquation, theSpeedOfSoundIsTheSlopeOfPressure)
{
    for (const Case& c : kCases)
        for (double f = 0.05; f < 1.0; f += 0.1) {
            const double rho = c.from + f * (c.to - c.from);
            const double d = 1e-5 * rho;
            const double slope = (stateAt(c.equation, rho + d, c.entropy).pressure -
                                  stateAt(c.equation, rho - d, c.entropy).pressure) /
                                 (2.0 * d);
            const double sound = stateAt(c.equation, rho, c.entropy).sound;
            EXPECT_NEAR(sound * sound, slope, 1e-6 * slope) << rho;
        }
}

TEST(StateEquation, heatRaisesTheEnergyByExactlyItself)
{
    for (const Case& c : kCases)
        for (const double heat : {1e-3, 1e2, 1e9}) {
            const StatePoint before = stateAt(c.equation, c.from, c.entropy);
            const StatePoint after = stateAt(c.equation, c.from, c.entropy + before.heatToEntropy * heat);
            EXPECT_NEAR(after.energy - before.energy, heat, 1e-12 * (after.energy + heat));
        }
}

TEST(StateEquation, energyGivesTheEntropyBack)
{
    for (const Case& c : kCases) {
        const double energy = stateAt(c.equation, c.to, c.entropy).energy;
        EXPECT_NEAR(entropyOf(c.equation, c.to, energy), c.entropy, 1e-9 * c.entropy);
    }
}

TEST(StateEquation, gasBelowTheColdCurveIsCold)
{
    EXPECT_EQ(entropyOf(water(), 1000.0, 1.0), 0.0);
    EXPECT_EQ(stateAt(StateEquation{}, 1.0, 0.0).sound, 0.0);
}

TEST(StateEquation, airHasThePressureAndSoundOfAir)
{
    StateEquation air;
    const StatePoint state = stateAt(air, 1.225, entropyOf(air, 1.225, 101325.0 / (0.4 * 1.225)));
    EXPECT_NEAR(state.pressure, 101325.0, 1e-6);
    EXPECT_NEAR(state.sound, 340.3, 0.1);
}

TEST(StateEquation, aChargeOfTntBeginsNearTheKnownPressure)
{
    // The products fill the charge's volume with 7 GJ/m3: by the curve itself between 8 and 9 GPa.
    const StatePoint state = stateAt(tnt(), 1630.0, entropyOf(tnt(), 1630.0, 7e9 / 1630.0));
    const double cold = 371.2e9 * std::exp(-4.15) + 3.231e9 * std::exp(-0.95);
    const double coldEnergy = 371.2e9 / 4.15 * std::exp(-4.15) + 3.231e9 / 0.95 * std::exp(-0.95);
    EXPECT_NEAR(state.pressure, cold + 0.3 * (7e9 - coldEnergy), 1e-6 * state.pressure);
    EXPECT_GT(state.pressure, 8e9);
    EXPECT_LT(state.pressure, 9e9);
}
