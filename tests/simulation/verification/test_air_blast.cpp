#include "simulation/verification/air_blast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fx::sim {
namespace {

TEST(AirBlast, aKilogramAtAMeterIsAboutNineAndAHalfAtmospheres)
{
    // Charts of free-air bursts show 130 to 150 psi at 1 m/kg^(1/3) and 27 to 31 psi at twice that.
    constexpr double kPsi = 6894.757;
    EXPECT_NEAR(kinneyGrahamOverpressure(1) / kPsi, 140, 10);
    EXPECT_NEAR(kingeryBulmashOverpressure(1) / kPsi, 140, 10);
    EXPECT_NEAR(kinneyGrahamOverpressure(2) / kPsi, 29, 2);
    EXPECT_NEAR(kingeryBulmashOverpressure(2) / kPsi, 29, 2);
}

TEST(AirBlast, bothFitsAgree)
{
    for (double z = 0.5; z <= 10; z *= 1.1)
        EXPECT_NEAR(kinneyGrahamOverpressure(z) / kingeryBulmashOverpressure(z), 1, 0.15) << z;
}

TEST(AirBlast, theWaveWeakensWithDistance)
{
    double last = 1e300;
    for (double z = 0.1; z < 40; z *= 1.2) {
        EXPECT_LT(kinneyGrahamOverpressure(z), last);
        last = kinneyGrahamOverpressure(z);
    }
}

std::vector<PressureSample> historyOf(const FriedlanderWave& wave, double smear)
{
    // A shock that is smeared over `smear` seconds: the mean of the wave over that time.
    std::vector<PressureSample> samples;
    for (int i = 0; i < 400; ++i) {
        const double time = i * 1e-5;
        double sum = 0;
        for (int k = 0; k < 100; ++k)
            sum += wave.at(time + smear * ((k + 0.5) / 100 - 0.5));
        samples.push_back({time, sum / 100});
    }
    return samples;
}

TEST(AirBlast, theFitFindsTheWaveAgain)
{
    const FriedlanderWave wave{2e5, 1.5e-3, 1.3, 1e-3};
    const FriedlanderWave fitted = fitFriedlander(historyOf(wave, 1e-6));
    EXPECT_NEAR(fitted.peak, wave.peak, 0.01 * wave.peak);
    EXPECT_NEAR(fitted.duration, wave.duration, 0.01 * wave.duration);
    EXPECT_NEAR(fitted.decay, wave.decay, 0.03);
}

TEST(AirBlast, aSmearedFrontKeepsItsPeak)
{
    const FriedlanderWave wave{2e5, 1.5e-3, 1.3, 1e-3};
    const auto samples = historyOf(wave, 3e-4);
    const FriedlanderWave fitted = fitFriedlander(samples);
    double highest = 0;
    for (const PressureSample& sample : samples)
        highest = std::max(highest, sample.overpressure);
    EXPECT_LT(highest, 0.85 * wave.peak);
    EXPECT_NEAR(fitted.peak, wave.peak, 0.04 * wave.peak);
    EXPECT_NEAR(fitted.arrival, wave.arrival, 5e-5);
}

TEST(AirBlast, silenceHasNoWave)
{
    const std::vector<PressureSample> silence(100, PressureSample{0, 0});
    EXPECT_EQ(fitFriedlander(silence).peak, 0);
    EXPECT_EQ(fitFriedlander({}).peak, 0);
}

} // namespace
} // namespace fx::sim
