#include "simulation/combustion/materials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace fx::sim;

TEST(Materials, areFoundByTheirNamesAndOnlyByThem)
{
    std::set<std::string_view> names;
    for (const Material& m : materials()) {
        EXPECT_TRUE(names.insert(m.name).second);
        EXPECT_EQ(findMaterial(m.name), &m);
    }
    EXPECT_EQ(names, (std::set<std::string_view>{"tnt", "petrol", "black-powder"}));
    EXPECT_EQ(findMaterial("TNT"), nullptr);
    EXPECT_EQ(findMaterial(""), nullptr);
}

TEST(Materials, haveFractionsBetweenZeroAndOne)
{
    for (const Material& m : materials()) {
        for (const double share : {m.ownOxygen, m.burningAtStart, m.flameSoot, m.smokeSoot, m.smokeSalt,
                                   kSootOptics.albedo, kSaltOptics.albedo})
        {
            EXPECT_GE(share, 0.0) << m.name;
            EXPECT_LE(share, 1.0) << m.name;
        }
        EXPECT_GT(m.ignitionDelay, 0.0);
        EXPECT_GT(m.burnTime, 0.0);
    }
}

TEST(Materials, burnInAirAsHotAsFlamesAtMost)
{
    for (const Material& m : materials()) {
        const double mass = 1.0 + m.airNeeded;
        const double adiabatic = 293.15 + (m.heatAtStart + m.heatOfCombustion) / (mass * m.heatCapacity);
        EXPECT_GT(adiabatic, 2200.0) << m.name;
        EXPECT_LT(adiabatic, 3100.0) << m.name;
    }
}

TEST(Materials, theDetonationOfTntIsConsistentInItself)
{
    const JwlConstants& jwl = findMaterial("tnt")->jwl;
    EXPECT_NEAR(jwl.energy / jwl.density / kTntEquivalent, 1.0, 0.05);
    // The pressure at the Chapman-Jouguet volume from the equation of state (with the energy of the Rayleigh
    // line and Hugoniot) equals that of the momentum balance, p = rho D^2 (1 - V), near the measured 21 GPa.
    const double impedance = jwl.density * jwl.speed * jwl.speed;
    double volume = 0.6;
    double least = 1e30;
    double atLeast = 0;
    for (; volume < 0.9; volume += 1e-4) {
        const double p = impedance * (1.0 - volume);
        const double energy = jwl.energy + 0.5 * p * (1.0 - volume);
        const double state = jwl.a * (1.0 - jwl.omega / (jwl.r1 * volume)) * std::exp(-jwl.r1 * volume) +
                             jwl.b * (1.0 - jwl.omega / (jwl.r2 * volume)) * std::exp(-jwl.r2 * volume) +
                             jwl.omega * energy / volume;
        if (std::abs(state - p) < least) {
            least = std::abs(state - p);
            atLeast = p;
        }
    }
    EXPECT_LT(least, 0.3e9);
    EXPECT_NEAR(atLeast / 21.0e9, 1.0, 0.03);
}

TEST(Materials, tntNeedsTheAirItsFormulaSays)
{
    const Material& tnt = *findMaterial("tnt");
    const double molarMass = 7 * 12.011 + 5 * 1.008 + 3 * 14.007 + 6 * 15.999;
    EXPECT_NEAR(tnt.airNeeded, 5.25 * 31.998 / molarMass / 0.232, 0.01);
    EXPECT_NEAR(tnt.flameSoot, 3.5 * 12.011 / molarMass, 0.001);
}
