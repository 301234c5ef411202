#include "simulation/emitters/births/birth_schedule.h"
#include "simulation/state/state_writer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

using namespace fx;
using namespace fx::sim;
using base::kTicksPerSecond;
using base::Ticks;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Emission steady(float rate, float start = 0, float duration = kInfinity)
{
    Emission emission;
    emission.rate = rate;
    emission.start = start;
    emission.duration = duration;
    return emission;
}

/// Births of [0, end) when time is cut at every multiple of `cut`.
std::vector<Birth> birthsUntil(const Emission& emission, float phase, Ticks end, Ticks cut)
{
    BirthSchedule schedule(emission, std::pmr::get_default_resource());
    schedule.setPhase(phase);
    std::vector<Birth> all;
    std::vector<Birth> out(100000);
    for (Ticks begin = 0; begin < end; begin += cut) {
        const BirthCount count = schedule.advance({begin, std::min(begin + cut, end)}, out);
        EXPECT_EQ(count.total, count.stored);
        all.insert(all.end(), out.begin(), out.begin() + count.stored);
    }
    return all;
}

uint64_t countUntil(const Emission& emission, float phase, Ticks end)
{
    BirthSchedule schedule(emission, std::pmr::get_default_resource());
    schedule.setPhase(phase);
    return schedule.advance({0, end}, {}).total;
}

} // namespace

TEST(BirthSchedule, theCountBeforeATimeIsClosedForm)
{
    for (const float rate : {1.0f, 7.0f, 59.94f, 1000.0f, 1e6f})
        for (const float phase : {0.0f, 0.25f, 0.999f})
            for (const double seconds : {0.001, 1.0, 10.0, 3600.0}) {
                const double want = std::ceil(double(rate) * seconds - double(phase));
                EXPECT_EQ(double(countUntil(steady(rate), phase, base::toTicks(seconds))),
                          std::max(want, 0.0))
                    << rate << " " << phase << " " << seconds;
            }
}

TEST(BirthSchedule, particleIIsBornAtItsExactTick)
{
    const std::vector<Birth> births = birthsUntil(steady(8.0f), 0.5f, kTicksPerSecond, kTicksPerSecond);
    ASSERT_EQ(births.size(), 8u);
    for (size_t i = 0; i < births.size(); ++i) {
        EXPECT_EQ(births[i].index, i);
        EXPECT_EQ(births[i].tick, (Ticks(2 * i + 1)) * kTicksPerSecond / 16);
    }
}

TEST(BirthSchedule, anyPartitionOfTimeGivesTheSameBirths)
{
    Emission emission = steady(333.3f, 0.01f, 0.9f);
    emission.bursts = {{0.5f, 3}, {0.0f, 2}, {0.5f, 4}};
    const Ticks end = kTicksPerSecond;
    const std::vector<Birth> want = birthsUntil(emission, 0.37f, end, end);
    for (const Ticks cut : {end / 30, end / 60, end / 144, Ticks(1234567), Ticks(99991)}) {
        const std::vector<Birth> got = birthsUntil(emission, 0.37f, end, cut);
        ASSERT_EQ(got.size(), want.size()) << cut;
        for (size_t i = 0; i < want.size(); ++i) {
            ASSERT_EQ(got[i].index, want[i].index) << cut;
            ASSERT_EQ(got[i].tick, want[i].tick) << cut;
        }
    }
}

TEST(BirthSchedule, evenBirthsAreThoseOfTheWindows)
{
    for (const float rate : {0.01f, 7.3f, 59.94f, 4000.0f})
        for (const float phase : {0.0f, 0.37f}) {
            const Ticks end = base::toTicks(rate < 1 ? 2000.0 : 20.0);
            const std::vector<Birth> want = birthsUntil(steady(rate), phase, end, kTicksPerSecond / 60);
            BirthSchedule schedule(steady(rate), std::pmr::get_default_resource());
            schedule.setPhase(phase);
            const Ticks from = 5 * kTicksPerSecond / 7;
            size_t i = schedule.advance({0, from}, {}).total;
            auto births = schedule.evenBirths(from, 1.0, true);
            ASSERT_TRUE(births.has_value());
            for (; births->tick < end; births->goOn(), ++i)
                ASSERT_EQ(births->tick, want.at(i).tick) << rate << ' ' << phase << ' ' << i;
            EXPECT_EQ(i, want.size());
        }
}

TEST(BirthSchedule, birthsThatDoNotComeEvenlyAreNotSaidToDo)
{
    Emission burst = steady(5.0f);
    burst.bursts = {{3.0f, 4}};
    Emission bent = steady(5.0f, 0, 10.0f);
    const std::array<base::CurveKey<1>, 2> keys{{{0.0f, {0.0f}}, {1.0f, {1.0f}}}};
    bent.rateOverTime = base::ScalarCurve(std::span<const base::CurveKey<1>>(keys));
    for (const Emission& emission : {burst, bent, steady(0.0f), steady(5.0f, 2.0f), steady(5.0f, 0, 0.5f)}) {
        BirthSchedule schedule(emission, std::pmr::get_default_resource());
        schedule.advance({0, kTicksPerSecond}, {});
        EXPECT_FALSE(schedule.evenBirths(kTicksPerSecond, 1.0, true).has_value());
    }
    BirthSchedule silent(steady(5.0f), std::pmr::get_default_resource());
    EXPECT_FALSE(silent.evenBirths(0, 1.0, false).has_value());
    EXPECT_FALSE(silent.evenBirths(0, 0.0, true).has_value());
}

TEST(BirthSchedule, indicesAndTicksAscend)
{
    Emission emission = steady(97.0f);
    emission.bursts = {{0.3f, 5}, {0.1f, 5}};
    const std::vector<Birth> births = birthsUntil(emission, 0.9f, kTicksPerSecond, kTicksPerSecond / 7);
    for (size_t i = 1; i < births.size(); ++i) {
        EXPECT_EQ(births[i].index, births[i - 1].index + 1);
        EXPECT_GE(births[i].tick, births[i - 1].tick);
    }
    EXPECT_EQ(births.size(), 97u + 10u);
}

TEST(BirthSchedule, aBurstAtTheStartAndTwoAtOneTickHappenOnceEach)
{
    Emission emission;
    emission.bursts = {{0.0f, 3}, {0.5f, 1}, {0.5f, 2}};
    EXPECT_EQ(birthsUntil(emission, 0, kTicksPerSecond, kTicksPerSecond / 2).size(), 6u);
    EXPECT_EQ(birthsUntil(emission, 0, kTicksPerSecond / 2, kTicksPerSecond / 4).size(),
              3u); // 0.5 s begins the next
}

TEST(BirthSchedule, startDelaysRateAndBurstsAndDurationEndsTheRate)
{
    Emission emission = steady(10.0f, 1.0f, 2.0f);
    emission.bursts = {{0.0f, 1}};
    const std::vector<Birth> births = birthsUntil(emission, 0, 10 * kTicksPerSecond, kTicksPerSecond / 3);
    ASSERT_EQ(births.size(), 21u);
    EXPECT_EQ(births.front().tick, kTicksPerSecond);
    EXPECT_LT(births.back().tick, 3 * kTicksPerSecond);
}

TEST(BirthSchedule, impossibleRatesGiveNothingAndHugeOnesAreCounted)
{
    for (const float rate : {0.0f, -5.0f, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_EQ(countUntil(steady(rate), 0, 3600 * kTicksPerSecond), 0u) << rate;
    for (const float rate : {1e9f, 1e18f, kInfinity})
        EXPECT_EQ(countUntil(steady(rate), 0, kTicksPerSecond), 1000000000u) << rate;
}

TEST(BirthSchedule, thirtySixHoursLoseNoParticle)
{
    const Ticks end = 36 * 3600 * kTicksPerSecond;
    EXPECT_EQ(countUntil(steady(1000.0f), 0.5f, end), 36u * 3600u * 1000u);
}

TEST(BirthSchedule, whatDoesNotFitIsCountedAndKeepsItsIndex)
{
    BirthSchedule schedule(steady(100.0f), std::pmr::get_default_resource());
    std::vector<Birth> out(10);
    const BirthCount first = schedule.advance({0, kTicksPerSecond}, out);
    EXPECT_EQ(first.total, 100u);
    EXPECT_EQ(first.stored, 10u);
    schedule.advance({kTicksPerSecond, 2 * kTicksPerSecond}, out);
    EXPECT_EQ(out[0].index, 100u);
}

TEST(BirthSchedule, intensityScalesAndSilenceSkips)
{
    Emission emission = steady(100.0f);
    emission.bursts = {{0.0f, 10}, {1.5f, 10}};
    BirthSchedule schedule(emission, std::pmr::get_default_resource());
    EXPECT_EQ(schedule.advance({0, kTicksPerSecond, 0.5, true}, {}).total, 55u);
    EXPECT_EQ(schedule.advance({kTicksPerSecond, 2 * kTicksPerSecond, 1.0, false}, {}).total, 0u);
    EXPECT_EQ(schedule.advance({2 * kTicksPerSecond, 3 * kTicksPerSecond, 2.0, true}, {}).total, 200u);
    EXPECT_EQ(schedule.advance({3 * kTicksPerSecond, 4 * kTicksPerSecond, -1.0, true}, {}).total, 0u);
}

TEST(BirthSchedule, isExhaustedAfterItsLastBirthOnly)
{
    Emission emission = steady(10.0f, 0.0f, 1.0f);
    emission.bursts = {{2.0f, 1}};
    BirthSchedule schedule(emission, std::pmr::get_default_resource());
    schedule.advance({0, kTicksPerSecond}, {});
    EXPECT_FALSE(schedule.exhausted(kTicksPerSecond));
    schedule.advance({kTicksPerSecond, 3 * kTicksPerSecond}, {});
    EXPECT_TRUE(schedule.exhausted(3 * kTicksPerSecond));
    EXPECT_FALSE(BirthSchedule(steady(1.0f), std::pmr::get_default_resource()).exhausted(kTicksPerSecond));
}

TEST(BirthSchedule, idleStepsLeaveTheSameStateAsOneLongWindow)
{
    const auto stateAfter = [](Ticks step) {
        Emission emission = steady(0.7f);
        emission.bursts = {{4.3f, 3}};
        BirthSchedule schedule(emission, std::pmr::get_default_resource());
        schedule.setPhase(0.25f);
        const Ticks change = 3 * kTicksPerSecond, end = 5 * kTicksPerSecond;
        for (Ticks at = 0; at < end; at += step) // the rate changes between births
            schedule.advance({at, at + step, at < change ? 1.0 : 0.4, true}, {});
        StateBuffer state(std::pmr::get_default_resource());
        schedule.save(state);
        return std::vector<std::byte>(state.bytes().begin(), state.bytes().end());
    };
    EXPECT_EQ(stateAfter(kTicksPerSecond / 60), stateAfter(kTicksPerSecond));
}
