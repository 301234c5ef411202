#include "simulation/combustion/parcel_optics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace fx::sim;

TEST(ParcelOptics, aGramOfSootBlocksSomeNineSquareMeters)
{
    Material m{};
    m.smokeSoot = 0.001;
    const ParcelOptics optics = opticsOf(m, {1.0, 0.0, 0.0, 1.0, 50.0, 300.0});
    EXPECT_NEAR(optics.extinction, 8.7, 1e-12);
    EXPECT_NEAR(optics.albedo, 0.22, 1e-12);
    EXPECT_NEAR(optics.absorption, 8.7 * 0.78, 1e-12);
}

TEST(ParcelOptics, unburntGasIsClear)
{
    for (const Material& m : materials()) {
        const ParcelOptics optics = opticsOf(m, {1.0, 1.0, 0.0, 0.0, 1.0, 400.0});
        EXPECT_EQ(optics.extinction, 0.0);
        EXPECT_EQ(optics.albedo, 0.0);
        EXPECT_EQ(emissivityOf(m, {1.0, 1.0, 0.0, 0.0, 1.0, 400.0}, 1.0), 0.0);
    }
}

TEST(ParcelOptics, petrolSmokeIsBlackAndPowderSmokeIsWhite)
{
    const FireParcel burnt{1.0, 0.0, 0.0, 1.0, 20.0, 400.0};
    EXPECT_LT(opticsOf(*findMaterial("petrol"), burnt).albedo, 0.25);
    EXPECT_LT(opticsOf(*findMaterial("tnt"), burnt).albedo, 0.25);
    EXPECT_GT(opticsOf(*findMaterial("black-powder"), burnt).albedo, 0.9);
}

TEST(ParcelOptics, emissivityGrowsFromTheThinLimitToOne)
{
    Material m{};
    m.smokeSoot = 0.01;
    const FireParcel p{0.02, 0.0, 0.0, 1.0, 1.0, 1500.0};
    const double S = opticsOf(m, p).absorption;
    EXPECT_NEAR(emissivityOf(m, p, 500.0) / S * (std::numbers::pi * 250000.0), 1.0, 1e-6);
    EXPECT_NEAR(emissivityOf(m, p, 0.05), 1.0, 1e-12);
    EXPECT_NEAR(emissivityOf(m, p, 1.0), 1.0 - std::exp(-S / std::numbers::pi), 1e-14);
}
