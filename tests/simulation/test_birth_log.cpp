// Births remembered as runs against the births themselves.
#include "foundation/random/philox.h"
#include "simulation/emitters/births/birth_schedule.h"

#include <gtest/gtest.h>

#include <limits>

using namespace fx;
using namespace fx::sim;
using base::kTicksPerSecond;
using base::Ticks;

namespace {

/// A schedule with its log and everything that it has given birth to.
struct Listened
{
    explicit Listened(const Emission& emission)
        : log(std::pmr::get_default_resource()), schedule(emission, std::pmr::get_default_resource())
    {
        schedule.setPhase(0.37f);
        schedule.setLog(&log);
    }
    void advance(Ticks begin, Ticks end, double intensity = 1.0)
    {
        std::vector<Birth> room(4096);
        auto keep = [&](std::span<const Birth> births) {
            all.insert(all.end(), births.begin(), births.end());
        };
        schedule.advance({begin, end, intensity}, room, ~uint64_t(0), keep);
    }

    BirthLog log;
    BirthSchedule schedule;
    std::vector<Birth> all;
};

Emission steady(float rate)
{
    Emission emission;
    emission.rate = rate;
    emission.duration = std::numeric_limits<float>::infinity();
    return emission;
}

/// Steps of very different lengths, the same for the same seed.
Ticks stepLength(uint64_t seed, uint64_t i)
{
    const float u = base::randomUnit4(seed, 0, i, base::RandomPurpose::Noise)[0];
    return 1 + Ticks(double(u * u) * 0.05 * double(kTicksPerSecond));
}

/// The age of each birth of the window, from what is published of the log.
void expectPublished(const BirthLog& log, const std::vector<Birth>& all, Ticks now)
{
    std::vector<base::GpuBirthRun> runs(log.runs());
    log.publish(now, runs);
    for (uint64_t i = log.front(); i < log.next(); ++i) {
        const auto distance = uint32_t(log.next() - i);
        size_t run = 0;
        while (run + 1 < runs.size() && distance <= runs[run + 1].reach)
            ++run;
        ASSERT_EQ(now - base::gpuBirthAge(runs[run], runs[run].reach - distance), all[i].tick) << i;
    }
}

} // namespace

TEST(BirthLog, anEvenRateIsOneRunHoweverTimeIsCut)
{
    for (const float rate : {0.3f, 7.0f, 59.94f, 1234.567f, 1e6f}) {
        Listened births(steady(rate));
        Ticks at = 0;
        for (uint64_t i = 0; i < 60; ++i) {
            const Ticks end = at + stepLength(uint64_t(rate), i);
            births.advance(at, end);
            at = end;
        }
        ASSERT_EQ(births.log.runs(), births.all.empty() ? 0u : 1u) << rate;
        ASSERT_EQ(births.log.next(), births.all.size());
        for (const Birth& birth : births.all)
            ASSERT_EQ(births.log.tickOf(birth.index), birth.tick) << rate << " " << birth.index;
        expectPublished(births.log, births.all, at);
    }
}

TEST(BirthLog, burstsAndChangesOfIntensityBeginNewRuns)
{
    Emission emission = steady(300.0f);
    emission.bursts = {{0.1f, 40, 0, 0.13f}, {0.25f, 7, 3, 0.01f}};
    emission.duration = 2.0f;
    Listened births(emission);
    Ticks at = 0;
    for (uint64_t i = 0; at < 2 * kTicksPerSecond; ++i) {
        const Ticks end = at + stepLength(3, i);
        births.advance(at, end, i % 9 < 5 ? 1.0 : 0.31);
        at = end;
        births.log.forget(at - kTicksPerSecond / 2);
        ASSERT_EQ(births.log.next(), births.all.size());
        if (births.log.empty())
            continue;
        const Ticks oldest = at - kTicksPerSecond / 2;
        const uint64_t front = births.log.front();
        EXPECT_TRUE(births.all[front].tick >= oldest && (front == 0 || births.all[front - 1].tick < oldest));
        expectPublished(births.log, births.all, at);
        std::vector<Ticks> ticks(size_t(births.log.next() - front));
        births.log.ticksOf(front, ticks);
        for (size_t k = 0; k < ticks.size(); ++k)
            ASSERT_EQ(ticks[k], births.all[front + k].tick);
    }
    EXPECT_GT(births.log.runs(), 6u);
}

/// 2^31 births of a run do not lose a tick: a day at 100,000 births a second, looked at now and then.
TEST(BirthLog, aDayOfBirthsStaysExact)
{
    Listened births(steady(99'999.7f));
    const Ticks day = 86'400 * kTicksPerSecond;
    births.schedule.advance({0, day}, {});
    const Ticks end = day + kTicksPerSecond / 20;
    births.advance(day, end);
    births.log.forget(day);
    ASSERT_EQ(births.log.front(), births.all.front().index);
    for (const Birth& birth : births.all)
        ASSERT_EQ(births.log.tickOf(birth.index), birth.tick);
    std::vector<base::GpuBirthRun> runs(births.log.runs());
    births.log.publish(end, runs);
    const auto reach = uint32_t(births.all.size());
    for (uint32_t j = 0; j < reach; ++j)
        ASSERT_EQ(end - base::gpuBirthAge(runs.back(), runs.back().reach - (reach - j)), births.all[j].tick);
}
