#include "simulation/combustion/fire_parcel.h"

#include "foundation/random/philox.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace fx::sim;

namespace {

/// A material of round numbers: ignites at once when hot, needs no air, no soot.
Material plain()
{
    Material m{};
    m.nominalEnergy = 1e6;
    m.heatOfCombustion = 2e6;
    m.ownOxygen = 1.0;
    m.heatCapacity = 1000.0;
    m.ignitionTemperature = 500.0;
    m.ignitionDelay = 0.3;
    m.burnTime = 0.7;
    return m;
}

Material sooty()
{
    Material m = *findMaterial("petrol");
    m.flameSoot = m.smokeSoot = 0.03; // the emissivity then stays as it is
    return m;
}

FireParcel unlit(double temperature)
{
    return {2.0, 0.8, 0.15, 1.0 - (0.8 + 0.15), 1.0, temperature};
}

/// The state after `seconds` in `steps` equal steps.
FireParcel play(const Material& m, FireParcel p, const FireSurroundings& around, double seconds, int steps,
                FireLedger& ledger)
{
    for (int i = 0; i < steps; ++i)
        p = burnParcel(m, p, around, seconds / steps, ledger);
    return p;
}

double sum(const FireParcel& p)
{
    return p.unburnt + p.burning + p.burnt;
}

void expectClose(const FireParcel& got, const FireParcel& want, double tolerance)
{
    EXPECT_NEAR(got.unburnt, want.unburnt, tolerance);
    EXPECT_NEAR(got.burning, want.burning, tolerance);
    EXPECT_NEAR(got.burnt, want.burnt, tolerance);
    EXPECT_NEAR(got.mixing / want.mixing, 1.0, tolerance);
    EXPECT_NEAR(got.temperature / want.temperature, 1.0, tolerance);
}

} // namespace

TEST(FireParcel, theThreeGasesAddUpToOneExactlyForAnyStep)
{
    for (uint64_t i = 0; i < 4000; ++i) {
        const auto u = fx::base::randomUnit4(7, 0, i, fx::base::RandomPurpose::Gas);
        const auto w = fx::base::randomUnit4(7, 1, i, fx::base::RandomPurpose::Gas);
        const Material& m = materials()[i % materials().size()];
        FireParcel p = startParcel(m, 0.01 + double(u[0]));
        p.temperature = 250.0 + 3000.0 * double(u[1]);
        FireLedger ledger;
        const FireSurroundings around{293.15, 2000.0 * double(w[0]), 3.0 * double(w[1]), 0.1 + double(w[2]),
                                      1.0};
        const double seconds = std::pow(10.0, -9.0 + 18.0 * double(u[2]));
        for (int k = 0; k < 5; ++k) {
            p = burnParcel(m, p, around, seconds, ledger);
            ASSERT_EQ(sum(p), 1.0) << i;
            ASSERT_GE(p.unburnt, 0.0);
            ASSERT_GE(p.burning, 0.0);
            ASSERT_GE(p.burnt, 0.0);
            ASSERT_TRUE(std::isfinite(p.temperature) && std::isfinite(ledger.radiated)) << i;
            ASSERT_LE(p.mixing, kMaxMixing);
        }
    }
}

TEST(FireParcel, aStepOfNothingOrNonsenseChangesNoBit)
{
    const FireParcel p = unlit(1500.0);
    for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        FireLedger ledger;
        const FireParcel q = burnParcel(sooty(), p, {293.15, 0.0, 1.0, 1.0, 1.0}, seconds, ledger);
        EXPECT_EQ(q.temperature, p.temperature);
        EXPECT_EQ(q.burning, p.burning);
        EXPECT_EQ(q.mixing, p.mixing);
        EXPECT_EQ(ledger.radiated, 0.0);
    }
}

TEST(FireParcel, theChainAgreesWithQuadrature)
{
    const Material m = plain();
    double u = 0.8;
    double g = 0.15;
    constexpr int kSteps = 20000;
    const double dt = 1.3 / kSteps;
    for (int i = 0; i < kSteps; ++i) { // midpoint rule
        const double um = u - 0.5 * dt * u / 0.3;
        const double gm = g + 0.5 * dt * (u / 0.3 - g / 0.7);
        u -= dt * um / 0.3;
        g += dt * (um / 0.3 - gm / 0.7);
    }
    FireLedger ledger;
    const FireParcel p = burnParcel(m, unlit(2000.0), {}, 1.3, ledger);
    EXPECT_NEAR(p.unburnt, u, 1e-8);
    EXPECT_NEAR(p.burning, g, 1e-8);
    EXPECT_NEAR(p.burnt, 1.0 - u - g, 1e-8);
}

TEST(FireParcel, equalAndNearlyEqualRatesAreNoSpecialCase)
{
    Material m = plain();
    FireLedger ledger;
    double last = 0;
    for (const double apart : {1e-3, 1e-6, 1e-9, 0.0, -1e-9, -1e-6}) {
        m.burnTime = m.ignitionDelay * (1.0 + apart);
        const FireParcel p = burnParcel(m, {1.0, 1.0, 0.0, 0.0, 1.0, 2000.0}, {}, 0.3, ledger);
        EXPECT_NEAR(p.burning, std::exp(-1.0), 1e-3 + 2.0 * std::abs(apart)); // k t exp(-k t) at k t = 1
        if (last > 0.0) {
            EXPECT_NEAR(p.burning, last, 1e-3);
        }
        last = p.burning;
    }
    m.burnTime = m.ignitionDelay;
    EXPECT_NEAR(burnParcel(m, {1.0, 1.0, 0.0, 0.0, 1.0, 2000.0}, {}, 0.3, ledger).burning, std::exp(-1.0),
                1e-15);
}

TEST(FireParcel, oneStepOfASecondIsAThousandOfAMillisecondWhereTheSolutionIsExact)
{
    FireLedger ledger;
    const Material chain = plain();
    const FireSurroundings kindled{293.15, 3000.0, 0.0, 1.0, 1.0}; // lit from outside, no mixing
    expectClose(play(chain, unlit(400.0), kindled, 1.0, 1000, ledger),
                play(chain, unlit(400.0), kindled, 1.0, 1, ledger), 1e-12);

    const FireSurroundings mixing{293.15, 0.0, 1.7, 1.0, 1.0}; // cold: only air comes in
    expectClose(play(chain, {1, 1, 0, 0, 1, 450.0}, mixing, 1.0, 1000, ledger),
                play(chain, {1, 1, 0, 0, 1, 450.0}, mixing, 1.0, 1, ledger), 1e-12);

    const FireSurroundings radiation{293.15, 0.0, 0.0, 1.0, 1.0};
    const FireParcel burnt{0.5, 0, 0, 1, 3.0, 2200.0};
    expectClose(play(sooty(), burnt, radiation, 1.0, 1000, ledger),
                play(sooty(), burnt, radiation, 1.0, 1, ledger), 1e-12);

    const FireSurroundings air{293.15, 3000.0, 0.4, 1.0, 0.0}; // air decides, nothing radiates
    Material fast = sooty();
    fast.ignitionDelay = fast.burnTime = 1e-7;
    expectClose(play(fast, {1, 0.5, 0.5, 0, 1, 900.0}, air, 1.0, 1000, ledger),
                play(fast, {1, 0.5, 0.5, 0, 1, 900.0}, air, 1.0, 1, ledger), 1e-12);
}

TEST(FireParcel, withEverythingAtOnceTheErrorFallsAtLeastAsTheStep)
{
    const Material& m = *findMaterial("petrol");
    const FireSurroundings around{293.15, 1500.0, 1.5, 0.6, 0.7};
    FireLedger ledger;
    const double want = play(m, startParcel(m, 0.05), around, 1.0, 65536, ledger).temperature;
    double last = 0;
    for (const int steps : {64, 128, 256, 512}) {
        const double error =
            std::abs(play(m, startParcel(m, 0.05), around, 1.0, steps, ledger).temperature - want);
        if (last > 0.0) {
            EXPECT_LT(error, 0.56 * last) << steps;
        }
        EXPECT_LT(error, 0.2 * want);
        last = error;
    }
}

TEST(FireParcel, energyIsNeitherMadeNorLost)
{
    for (uint64_t i = 0; i < 500; ++i) {
        const auto u = fx::base::randomUnit4(11, 0, i, fx::base::RandomPurpose::Gas);
        const Material& m = materials()[i % materials().size()];
        FireParcel p = startParcel(m, 0.1);
        const FireSurroundings around{293.15, 1800.0, 4.0 * double(u[0]), 0.2 + double(u[1]), double(u[2])};
        const double dt = std::pow(10.0, -4.0 + 5.0 * double(u[3]));
        const double before = heatOf(m, p, 293.15);
        FireLedger ledger;
        for (int k = 0; k < 200; ++k)
            p = burnParcel(m, p, around, dt, ledger);
        const double balance =
            before + ledger.released - ledger.radiated - ledger.givenToAir - heatOf(m, p, 293.15);
        // Temperatures are rounded, so each step may lose a bit of what parcel and air hold above absolute
        // zero.
        const double held = 0.1 * p.mixing * m.heatCapacity * std::max(p.temperature, 293.15);
        EXPECT_NEAR(balance, 0.0, 1e-13 * (before + ledger.released) + 200 * 2.3e-16 * held) << i;
        EXPECT_NEAR(ledger.released / (0.1 * m.heatOfCombustion), p.burnt, 1e-12)
            << i; // fuel burnt times its heat
    }
}

TEST(FireParcel, fuelBurnsAsFastAsAirReachesIt)
{
    const Material& m = *findMaterial("petrol");
    FireLedger ledger;
    const FireParcel starved =
        play(m, startParcel(m, 1.0), {293.15, 1500.0, 0.0, 1.0, 1.0}, 10.0, 100, ledger);
    EXPECT_EQ(starved.burnt, 0.0);
    EXPECT_EQ(ledger.released, 0.0);
    const FireParcel fed = play(m, startParcel(m, 1.0), {293.15, 1500.0, 0.5, 1.0, 1.0}, 2.0, 120, ledger);
    EXPECT_NEAR(fed.burnt, (fed.mixing - 1.0) / m.airNeeded, 1e-12);
    EXPECT_NEAR(fed.mixing, std::exp(1.0), 1e-12);
    const FireParcel done = play(m, fed, {293.15, 1500.0, 0.5, 1.0, 1.0}, 10.0, 600, ledger);
    EXPECT_NEAR(done.burnt, 1.0, 1e-9);
}

TEST(FireParcel, blackPowderBurnsWithoutAirAndTntDoesNot)
{
    FireLedger ledger;
    for (const Material& m : materials()) {
        const FireParcel p = play(m, startParcel(m, 1.0), {293.15, 0.0, 0.0, 1.0, 0.0}, 1.0, 10, ledger);
        EXPECT_EQ(p.burnt > 0.999, m.name == "black-powder") << m.name;
    }
}

TEST(FireParcel, nothingColdIgnites)
{
    const Material& m = *findMaterial("petrol");
    EXPECT_EQ(ignitionRate(m, m.ignitionTemperature), 0.0);
    EXPECT_GT(ignitionRate(m, m.ignitionTemperature + 30.0), 0.0);
    EXPECT_DOUBLE_EQ(ignitionRate(m, 2.0 * m.ignitionTemperature), 1.0 / m.ignitionDelay);
    FireLedger ledger;
    const FireParcel cold{1.0, 1.0, 0.0, 0.0, 5.0, 320.0};
    EXPECT_EQ(burnParcel(m, cold, {293.15, 0.0, 0.1, 1.0, 1.0}, 100.0, ledger).unburnt, 1.0);
    EXPECT_LT(burnParcel(m, cold, {293.15, 1500.0, 0.1, 1.0, 1.0}, 100.0, ledger).unburnt, 1e-6);
}

TEST(FireParcel, radiationFollowsTheClosedFormAndNeverGoesBelowTheAir)
{
    const Material m = sooty();
    const FireParcel hot{0.5, 0.0, 0.0, 1.0, 3.0, 2000.0};
    const FireSurroundings around{293.15, 0.0, 0.0, 0.8, 1.0};
    FireLedger ledger;
    const double area = 4.0 * std::numbers::pi * 0.8 * 0.8;
    const double emissivity =
        1.0 - std::exp(-8700.0 * (1.0 - 0.22) * 0.5 * 0.03 / (std::numbers::pi * 0.8 * 0.8));
    double T = 2000.0;
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) {
        const double slope = area * emissivity * 5.670374419e-8 / (0.5 * 3.0 * m.heatCapacity);
        const double middle = T - 0.5 * (0.5 / kSteps) * slope * T * T * T * T;
        T -= (0.5 / kSteps) * slope * middle * middle * middle * middle;
    }
    EXPECT_NEAR(burnParcel(m, hot, around, 0.5, ledger).temperature, T, 1e-5);
    EXPECT_EQ(burnParcel(m, hot, around, 1e9, ledger).temperature, 293.15);
    const FireParcel cold{0.5, 0.0, 0.0, 1.0, 3.0, 250.0};
    EXPECT_NEAR(burnParcel(m, cold, around, 1.0, ledger).temperature, 250.0, 1e-12);
}

TEST(FireParcel, aThermalDrawsInAirAsItsSpeedOverItsRadius)
{
    EXPECT_DOUBLE_EQ(entrainmentRate(4.0, 2.0, 0.5), 3.0);
    EXPECT_EQ(entrainmentRate(-1.0, 2.0, 0.5), 0.0);
    EXPECT_EQ(entrainmentRate(1.0, 0.0, 0.5), 0.0);
    // A thermal of constant density grows as R = R0 + 0.25 z: dM/dt / M = 3 dR/dt / R.
    const double rate = entrainmentRate(3.0, 1.0, 1.0);
    EXPECT_DOUBLE_EQ(rate, 3.0 * 0.25 * 3.0);
}
