// The hard cases of emitters, EM-01 to EM-10, each by its name. The longer tests of the same matters:
// EM-01, EM-03 test_emitter_limits.cpp; EM-02 test_birth_schedule.cpp, test_birth_rates.cpp; EM-04
// test_frame_partition.cpp; EM-05 test_emitter_seek.cpp; EM-06 test_particle_determinism.cpp; EM-08
// test_birth_kernel.cpp; EM-09 test_curve.cpp; EM-10 test_shapes.cpp.
#include "foundation/math/hash.h"
#include "foundation/random/philox.h"
#include "simulation/emitters/births/birth_schedule.h"
#include "simulation/emitters/births/birth_shape.h"
#include "tests/foundation/real_threads.h"
#include "tests/simulation/particles/core/sprites.h"
#include "tests/simulation/particles/modules/chi_square.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <limits>
#include <set>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;
using base::kTicksPerSecond;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

StepCounters playedWith(float rate, base::Range lifetime)
{
    Stage stage;
    stage.add({}, spriteEmitter(rate, lifetime));
    stage.play(6);
    return stage.counters();
}

/// Hash of what is seen after two seconds that are cut as `cut` says.
template <class Cut>
uint64_t hashOfTwoSeconds(Cut cut, std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner())
{
    Stage stage(std::move(tasks));
    stage.add({}, spriteEmitter(700.0f, {0.3f, 1.1f}));
    for (int i = 0; stage.now() < 2 * kTicksPerSecond; ++i)
        stage.step(std::min<base::Ticks>(cut(i), 2 * kTicksPerSecond - stage.now()));
    return stage.look().hash();
}

} // namespace

TEST(EmitterCases, EM01_ratesOfEveryKindGiveNothingOrAreCapped)
{
    for (const float rate : {0.0f, -5.0f, kNaN})
        EXPECT_EQ(playedWith(rate, {1, 1}).born, 0u) << rate;
    for (const float rate : {1e9f, 1e18f, kInfinity}) {
        const StepCounters counters = playedWith(rate, {1, 1});
        EXPECT_EQ(counters.born - counters.dropped, 1024u) << rate;
        EXPECT_GT(counters.dropped, 0u) << rate;
    }
}

TEST(EmitterCases, EM02_burstsHappenOnceEachAlsoAtTheSameTickAndAtTheEndOfALoop)
{
    Emission emission;
    emission.duration = 1.0f;
    emission.bursts = {
        {0.0f, 3}, {0.0f, 5}, {0.0f, 2, 0, 0.5f, 1.0f}}; // the last at 0 and 0.5, not at the end
    for (const base::Ticks part : {2 * kTicksPerSecond, kTicksPerSecond / 60, kTicksPerSecond / 7}) {
        BirthSchedule schedule(emission, std::pmr::get_default_resource());
        schedule.setPhase(0.5f);
        std::vector<base::Ticks> ticks;
        for (base::Ticks now = 0; now < 2 * kTicksPerSecond; now += part) {
            std::array<Birth, 64> room;
            const BirthCount count = schedule.advance({now, now + part, 1.0, true}, room);
            for (size_t i = 0; i < count.stored; ++i)
                ticks.push_back(room[i].tick);
        }
        ASSERT_EQ(ticks.size(), 3u + 5u + 2u + 2u) << part;
        EXPECT_EQ(ticks[9], 0);
        EXPECT_EQ(ticks[10], kTicksPerSecond / 2);
    }
}

TEST(EmitterCases, EM03_lifetimesOfEveryKindEnd)
{
    for (const float life : {0.0f, -1.0f, kNaN, 1e-4f}) {
        Stage stage;
        const Slot slot = stage.add({}, spriteEmitter(600.0f, {life, life}));
        stage.play(30);
        EXPECT_EQ(stage.counters().born, 300u) << life;
        EXPECT_LE(stage.world().elementCount(slot), 1u) << life; // the one that was born just now
    }
    Stage stage;
    const Slot slot = stage.add({}, spriteEmitter(60.0f, {kInfinity, kInfinity}));
    stage.play(300);
    EXPECT_EQ(stage.world().elementCount(slot), 300u);
}

TEST(EmitterCases, EM04_anyFramesGiveTheSameBits)
{
    const auto every = [](double hertz) {
        return [hertz](int) { return base::Ticks(double(kTicksPerSecond) / hertz); };
    };
    const uint64_t want = hashOfTwoSeconds(every(60));
    for (const double hertz : {30.0, 144.0, 240.0, 1.0 / 3600.0})
        EXPECT_EQ(hashOfTwoSeconds(every(hertz)), want) << hertz;
    EXPECT_EQ(hashOfTwoSeconds([](int i) { return base::Ticks(1 + (i * 7919) % 9'999'991); }), want);
}

TEST(EmitterCases, EM05_aThousandJumpsAreEqualToPlaying)
{
    constexpr int kSteps = 100;
    std::vector<uint64_t> want;
    Stage played, jumped;
    const auto def = [] { return spriteEmitter(200.0f, {0.3f, 1.1f}); };
    played.add({}, def());
    const Slot slot = jumped.add({}, def());
    for (int i = 0; i < kSteps; ++i) {
        played.step();
        want.push_back(played.world().hash(std::array{Slot(0)}));
    }
    jumped.step();
    uint32_t random = 1;
    for (int jump = 0; jump < 1000; ++jump) {
        random = random * 1664525u + 1013904223u;
        const int step = int(random >> 8) % kSteps;
        StepCounters counters;
        jumped.world().seekTo(slot, (step + 1) * kStep, kStep, counters);
        ASSERT_EQ(jumped.world().hash(std::array{slot}), want[size_t(step)]) << step;
    }
}

TEST(EmitterCases, EM06_threadsOneToThirtyTwoGiveTheSameBits)
{
    const RealThreads threadsOfAnyMachine(32);
    const auto cut = [](int) { return kStep; };
    const uint64_t want = hashOfTwoSeconds(cut);
    for (uint32_t threads = 1; threads <= 32; ++threads)
        EXPECT_EQ(hashOfTwoSeconds(cut, base::makeTbbRunner(threads)), want) << threads;
}

TEST(EmitterCases, EM07_compilersAndTheirSwitchesAgreeAfterTwoThousandSteps)
{
    // What gcc 12 with -O3 gives for x86-64; other compilers and switches run this same test.
    constexpr uint64_t kWant = 0xc0390b52a63b3f9b;
    Stage stage;
    auto integrated = spriteEmitter(120.0f, {0.3f, 1.1f});
    integrated->forces.curlStrength = 1.5f;
    integrated->forces.bounce = 0.4f;
    integrated->modules = {std::make_shared<Idle>()};
    stage.add({}, spriteEmitter(300.0f, {0.3f, 1.1f}), std::move(integrated));
    uint64_t hash = 0;
    for (int i = 0; i < 2000; ++i) {
        stage.step();
        if (i % 100 == 99)
            hash = base::hashWord(hash, stage.look().hash());
    }
    EXPECT_EQ(hash, kWant) << std::hex << hash;
}

TEST(EmitterCases, EM08_indicesWrapNowhereAndAgesStayExact)
{
    for (const uint64_t around : {uint64_t(1) << 32, uint64_t(1) << 53, uint64_t(1) << 61}) {
        std::set<std::array<float, 4>> seen;
        for (uint64_t i = around - 500; i < around + 500; ++i)
            seen.insert(base::randomUnit4(7, 0, i, base::RandomPurpose::Life));
        for (uint64_t i = 0; i < 1000; ++i) // what a counter of 32 bits would begin anew
            seen.insert(base::randomUnit4(7, 0, i, base::RandomPurpose::Life));
        EXPECT_EQ(seen.size(), 2000u) << around;
    }
    // After 36 hours ages still rise by exactly a step: they are counted from the birth.
    Stage stage;
    auto def = rateEmitter(10.0f, 2.0f);
    def->appearance.kind = AppearanceKind::Sprite;
    const Slot slot = stage.add({}, std::move(def));
    stage.step(1);
    StepCounters counters;
    stage.world().seekTo(slot, 131'072 * kTicksPerSecond, kStep, counters);
    const auto ages = [&stage] {
        const base::SnapshotGroup& group = stage.look().group(0);
        return std::vector<float>(group.column(base::particle_column::Age).begin(),
                                  group.column(base::particle_column::Age).end());
    };
    const auto before = ages();
    const base::Ticks part = kTicksPerSecond / 240;
    stage.step(part);
    const auto after = ages();
    int compared = 0;
    for (size_t i = 0; i < std::min(before.size(), after.size()); ++i)
        if (before[i] > 0.0f && after[i] > before[i]) {
            EXPECT_NEAR(after[i] - before[i], base::toSeconds(part), 3e-7);
            ++compared;
        }
    EXPECT_GT(compared, 15);
}

TEST(EmitterCases, EM09_curvesOfAnyKeysAreDefined)
{
    uint32_t random = 7;
    const auto unit = [&random] {
        random = random * 1664525u + 1013904223u;
        return float(random >> 8) / 16777216.0f;
    };
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<base::CurveKey<1>> keys(1 + size_t(unit() * 12.0f));
        float low = kInfinity, high = -kInfinity;
        for (base::CurveKey<1>& key : keys) {
            key = {unit() < 0.3f ? 0.5f : unit(), {unit() * 20.0f - 10.0f}}; // many at the same place
            low = std::min(low, key.value[0]);
            high = std::max(high, key.value[0]);
        }
        std::stable_sort(keys.begin(), keys.end(),
                         [](const auto& a, const auto& b) { return a.t < b.t; }); // loaders refuse others
        const base::ScalarCurve curve{std::span<const base::CurveKey<1>>(keys)};
        for (const float t : {-1.0f, 0.0f, unit(), 0.5f, 1.0f, 7.0f, kNaN, kInfinity, -kInfinity}) {
            const float value = curve.at(t)[0];
            ASSERT_GE(value, low - 1e-4f) << t;
            ASSERT_LE(value, high + 1e-4f) << t;
        }
    }
}

TEST(EmitterCases, EM10_millionsOfBirthsAreEven)
{
    EmitterDef ball, cone;
    ball.shape = EmitterShape::Sphere;
    ball.size = {2, 0, 0};
    cone.shape = EmitterShape::Cone;
    cone.size = {1, 0, 0};
    cone.angle = 0.8f;
    const double cosLimit = std::cos(double(cone.angle));
    EqualCells radii(100), heights(100), discs(100), cosines(100);
    for (uint64_t i = 0; i < 1'000'000; ++i) {
        const auto place = base::randomUnit4(3, 0, i, base::RandomPurpose::Position);
        const auto heading = base::randomUnit4(3, 0, i, base::RandomPurpose::Direction);
        const glm::vec3 inBall = sampleBirth(ball, place, heading).position;
        const double r = double(glm::length(inBall)) / 2.0;
        radii.add(r * r * r);
        heights.add(r > 0 ? 0.5 + 0.5 * double(inBall.y) / (2.0 * r) : 0.5);
        const BirthPlace onDisc = sampleBirth(cone, place, heading);
        discs.add(double(glm::dot(onDisc.position, onDisc.position)));
        cosines.add((1.0 - double(onDisc.direction.y)) / (1.0 - cosLimit));
    }
    for (const EqualCells* cells :
         {&radii, &heights, &discs, &cosines}) // 1 % for all together (Sidak): z = 2.81
        EXPECT_LT(cells->chiSquare(), chiSquareLimit(cells->degrees(), 2.81));
}
