#include "simulation/emitters/births/birth_schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace fx;
using namespace fx::sim;
using base::kTicksPerSecond;
using base::Ticks;

namespace {

Emission ramp(float rate, float duration, std::vector<base::CurveKey<1>> keys)
{
    Emission emission;
    emission.rate = rate;
    emission.duration = duration;
    emission.rateOverTime = base::ScalarCurve(std::span<const base::CurveKey<1>>(keys));
    return emission;
}

/// Births of [0, end) when time is cut by `cut`, and a little unevenly when `uneven` is not 0.
std::vector<Birth> birthsOf(const Emission& emission, Ticks end, Ticks cut, Ticks uneven = 0,
                            uint64_t seed = 1, double intensity = 1.0)
{
    BirthSchedule schedule(emission, std::pmr::get_default_resource());
    schedule.setPhase(0.25f);
    schedule.setSeed(seed, 3);
    std::vector<Birth> all, out(200000);
    Ticks step = 0;
    for (Ticks begin = 0; begin < end;) {
        const Ticks next = std::min(begin + cut + (step++ % 7) * uneven, end);
        const BirthCount count = schedule.advance({begin, next, intensity, true}, out);
        EXPECT_EQ(count.total, count.stored);
        all.insert(all.end(), out.begin(), out.begin() + count.stored);
        begin = next;
    }
    return all;
}

void expectEqual(const std::vector<Birth>& a, const std::vector<Birth>& b)
{
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].tick, b[i].tick) << i;
        ASSERT_EQ(a[i].index, b[i].index) << i;
    }
}

} // namespace

TEST(BirthRates, aRampGivesTheIntegralOfItsRate)
{
    // rate 2000 t over 2 s: 1000 t^2 births before t, particle i at sqrt((i + phase) / 1000) seconds.
    const std::vector<Birth> births =
        birthsOf(ramp(4000.0f, 2.0f, {{0, {0}}, {1, {1}}}), 3 * kTicksPerSecond, kTicksPerSecond / 60);
    ASSERT_EQ(births.size(), 4000u);
    for (const size_t i : {0u, 1u, 10u, 500u, 1000u, 3999u})
        EXPECT_NEAR(base::toSeconds(births[i].tick), std::sqrt((double(i) + 0.25) / 1000.0), 2e-7) << i;
}

TEST(BirthRates, aFallingRateGivesTheIntegralToo)
{
    // 3000 (1 - t) over 1 s: 3000 (t - t^2 / 2) births before t.
    const std::vector<Birth> births =
        birthsOf(ramp(3000.0f, 1.0f, {{0, {1}}, {1, {0}}}), kTicksPerSecond, kTicksPerSecond);
    ASSERT_EQ(births.size(), 1500u);
    for (const size_t i : {0u, 7u, 700u, 1499u}) {
        const double n = (double(i) + 0.25) / 3000.0;
        EXPECT_NEAR(base::toSeconds(births[i].tick), 1.0 - std::sqrt(1.0 - 2.0 * n), 2e-6) << i;
    }
}

TEST(BirthRates, anyPartitionOfTimeGivesTheSameBirths)
{
    Emission emission = ramp(700.0f, 3.7f, {{0, {0.2f}}, {0.3f, {2}}, {0.5f, {0}}, {0.6f, {0}}, {1, {1}}});
    emission.start = 0.13f;
    emission.bursts = {{0.5f, 5, 4, 0.31f, 1.0f}, {0.1f, 3, 0, 0.2f, 0.5f}};
    const Ticks end = 5 * kTicksPerSecond;
    const std::vector<Birth> once = birthsOf(emission, end, end);
    EXPECT_GT(once.size(), 1000u);
    for (const Ticks rate : {30, 60, 144, 240, 1000})
        expectEqual(once, birthsOf(emission, end, kTicksPerSecond / rate));
    expectEqual(once, birthsOf(emission, end, 1234567, 7654321));
    for (size_t i = 1; i < once.size(); ++i) {
        ASSERT_LE(once[i - 1].tick, once[i].tick);
        ASSERT_EQ(once[i].index, once[i - 1].index + 1);
    }
}

TEST(BirthRates, intensityScalesARampExactlyAsItsRateWould)
{
    const std::vector<base::CurveKey<1>> keys{{0, {0}}, {1, {1}}};
    expectEqual(birthsOf(ramp(1000.0f, 2.0f, keys), 2 * kTicksPerSecond, 9999999, 0, 1, 2.0),
                birthsOf(ramp(2000.0f, 2.0f, keys), 2 * kTicksPerSecond, 12345678));
}

TEST(BirthRates, aCurveIsTakenWhateverItSays)
{
    for (const float rate : {0.0f, -5.0f, std::nanf(""), INFINITY}) {
        BirthSchedule schedule(ramp(rate, 1.0f, {{0, {0}}, {1, {1}}}), std::pmr::get_default_resource());
        const uint64_t want = rate > 0.0f ? 496093750u : 0u; // bounded by 1e9 /s from the first sample on
        EXPECT_NEAR(double(schedule.advance({0, kTicksPerSecond}, {}).total), double(want), 0.51e9) << rate;
    }
    BirthSchedule longest(ramp(1e9f, 1e6f, {{0, {1}}, {1, {0.5f}}}), std::pmr::get_default_resource());
    // Eleven days: the rounded slope is off by up to L 2^-48 = 0.04 /s.
    EXPECT_NEAR(double(longest.advance({0, 1'000'000 * kTicksPerSecond}, {}).total), 7.5e14, 2e4);
    BirthSchedule negative(ramp(10.0f, 1.0f, {{0, {-1}}, {1, {-2}}}), std::pmr::get_default_resource());
    EXPECT_EQ(negative.advance({0, kTicksPerSecond}, {}).total, 0u);
    Emission tiny = ramp(1e9f, 1e-8f, {{0, {1}}, {1, {0}}}); // 7 ticks
    BirthSchedule brief(tiny, std::pmr::get_default_resource());
    EXPECT_LE(brief.advance({0, kTicksPerSecond}, {}).total, 10u);
}

TEST(BirthRates, burstsRepeatAtExactTicks)
{
    Emission emission;
    emission.bursts = {{0.5f, 2, 3, 0.25f, 1.0f}};
    const std::vector<Birth> births = birthsOf(emission, 3 * kTicksPerSecond, kTicksPerSecond / 60);
    ASSERT_EQ(births.size(), 6u);
    for (size_t i = 0; i < 6; ++i)
        EXPECT_EQ(births[i].tick, kTicksPerSecond / 2 + Ticks(i / 2) * kTicksPerSecond / 4);
}

TEST(BirthRates, burstsForEverEndWithTheEmission)
{
    Emission emission;
    emission.duration = 1.0f;
    emission.bursts = {{0.0f, 1, 0, 0.1f, 1.0f}};
    EXPECT_EQ(birthsOf(emission, 10 * kTicksPerSecond, kTicksPerSecond / 7).size(), 10u);
    BirthSchedule endless({10, 0, INFINITY, {{0.0f, 1, 0, 0.1f, 1.0f}}}, std::pmr::get_default_resource());
    EXPECT_FALSE(endless.exhausted(1000 * kTicksPerSecond));
    emission.bursts[0].interval = 0.0f; // cannot repeat
    EXPECT_EQ(birthsOf(emission, kTicksPerSecond, kTicksPerSecond).size(), 1u);
}

TEST(BirthRates, burstsOfTheSameTickComeInTheOrderOfTheirDeclaration)
{
    Emission emission;
    emission.bursts = {{1.0f, 1, 1, 0, 1}, {0.0f, 1, 3, 0.5f, 1.0f}};
    BirthSchedule schedule(emission, std::pmr::get_default_resource());
    std::vector<Birth> out(10);
    ASSERT_EQ(schedule.advance({0, 2 * kTicksPerSecond}, out).stored, 4u);
    EXPECT_EQ(out[2].tick, out[3].tick);
    EXPECT_TRUE(schedule.exhausted(2 * kTicksPerSecond));
}

TEST(BirthRates, aProbabilityIsDrawnForEachCycleFromTheSeed)
{
    Emission emission;
    emission.duration = 1e5f;
    emission.bursts = {{0.0f, 1, 10000, 0.1f, 0.3f}};
    const size_t happened = birthsOf(emission, 2000 * kTicksPerSecond, kTicksPerSecond).size();
    EXPECT_NEAR(double(happened), 3000.0, 3.5 * std::sqrt(10000 * 0.3 * 0.7));
    const std::vector<Birth> a = birthsOf(emission, 100 * kTicksPerSecond, kTicksPerSecond, 0, 1);
    expectEqual(a, birthsOf(emission, 100 * kTicksPerSecond, kTicksPerSecond / 3, 0, 1));
    const std::vector<Birth> b = birthsOf(emission, 100 * kTicksPerSecond, kTicksPerSecond, 0, 2);
    EXPECT_FALSE(a.size() == b.size() &&
                 std::equal(a.begin(), a.end(), b.begin(),
                            [](const Birth& x, const Birth& y) { return x.tick == y.tick; }));
}

TEST(BirthRates, aScheduleGoesOnFromItsSavedState)
{
    Emission emission = ramp(700.0f, 3.7f, {{0, {0.2f}}, {1, {2}}});
    emission.bursts = {{0.1f, 3, 8, 0.3f, 0.5f}};
    std::pmr::memory_resource* const memory = std::pmr::get_default_resource();
    BirthSchedule first(emission, memory);
    first.setPhase(0.7f);
    first.setSeed(5, 0);
    std::vector<Birth> a(10000), b(10000);
    first.advance({0, kTicksPerSecond}, a);
    StateBuffer writer(memory);
    first.save(writer);
    BirthSchedule second(emission, memory);
    second.setSeed(5, 0);
    StateReader reader(writer.bytes());
    second.restore(reader);
    ASSERT_TRUE(reader.ok()) << reader.status().message();
    const BirthWindow rest{kTicksPerSecond, 4 * kTicksPerSecond};
    a.resize(first.advance(rest, a).stored);
    b.resize(second.advance(rest, b).stored);
    expectEqual(a, b);
}
