#include "simulation/emitters/emitter_def.h"
#include "simulation/fragments/fragments_solver.h"
#include "tests/simulation/fragments/fragment_burst.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace fx;
using namespace fx::test;
namespace blob = fx::base::blob_column;

namespace {

std::span<const float> column(const base::FrameSnapshot& snapshot, size_t group, size_t index)
{
    return snapshot.group(group).column(index);
}

/// Gaps between neighboring blobs of the smoke of one fragment that flew straight up without drag for 0.8 s.
std::vector<float> gaps(base::Ticks step)
{
    auto def = oneFragment(20.0f);
    def->matter.gravity = 0.0f;
    def->temperature = {1600.0f, 1600.0f};
    def->trail.spacing = 0.31f;
    def->trail.lifetime = {100.0f, 100.0f};
    def->trail.inherited = 0.0f;
    def->trail.buoyancy = 0.0f;
    def->trail.curlStrength = 0.0f;
    Stage stage;
    stage.add({}, std::move(def));
    while (stage.now() < base::kTicksPerSecond * 4 / 5)
        stage.step(step);
    const auto y = column(stage.look(), 1, blob::PositionY);
    std::vector<float> heights(y.begin(), y.end());
    std::sort(heights.begin(), heights.end());
    std::vector<float> out;
    for (size_t i = 1; i < heights.size(); ++i)
        out.push_back(heights[i] - heights[i - 1]);
    return out;
}

std::vector<uint64_t> trailIds(base::Ticks step)
{
    auto def = burst(20);
    def->lifetime = def->trail.lifetime = {100.0f, 100.0f};
    def->trail.maxBlobs = 20000;
    Stage stage;
    stage.add({}, std::move(def)); // no ground: a bounce within a step would shorten its chord
    while (stage.now() < base::kTicksPerSecond)
        stage.step(step);
    const auto ids = stage.look().group(1).ids();
    EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()))
        << step; // readers find the same blob of another step so
    return {ids.begin(), ids.end()};
}

} // namespace

TEST(FragmentsSolver, aFragmentFliesAParabolaFromTheTickOfItsStart)
{
    auto def = oneFragment(20.0f);
    def->start = 0.5f / 60.0f + 0.1f; // inside a step
    Stage stage;
    stage.add({}, std::move(def));
    stage.play(6);
    EXPECT_EQ(stage.look().group(0).count(), 0u);
    stage.play(84);
    const double t = 1.5 - (0.5 / 60.0 + 0.1);
    const auto& snapshot = stage.look();
    EXPECT_NEAR(column(snapshot, 0, blob::PositionY)[0], 20.0 * t - 0.5 * 9.80665 * t * t, 1e-4);
    EXPECT_NEAR(column(snapshot, 0, blob::VelocityY)[0], 20.0 - 9.80665 * t, 1e-4);
    EXPECT_EQ(snapshot.groupCount(), 2u);
    EXPECT_EQ(snapshot.group(1).count(), 0u); // no smoke was asked for
}

TEST(FragmentsSolver, aBounceKeepsTheSquareOfTheRestitutionOfTheEnergy)
{
    auto def = oneFragment(0.0f);
    def->position = {0.0f, 2.0f, 0.0f};
    def->matter.bounce = 0.5f;
    def->size = {0.02f, 0.02f};
    Stage stage;
    stage.add({}, grounded(std::move(def)));
    const auto height = [&] { return column(stage.look(), 0, blob::PositionY)[0]; };
    double top = 0;
    double lowest = 2.0;
    bool bounced = false;
    for (int i = 0; i < 400 && !(bounced && top > 0 && lowest < 0.011); ++i) {
        stage.step(base::kTicksPerSecond / 240);
        bounced |= column(stage.look(), 0, blob::VelocityY)[0] > 0.0f;
        top = bounced ? std::max(top, double(height())) : 0;
        ASSERT_GE(height(), 0.01f - 1e-6f); // its own radius above the ground
        if (bounced && top > 0.3)
            break;
        lowest = std::min(lowest, double(height()));
    }
    for (int i = 0; i < 240; ++i) {
        stage.step(base::kTicksPerSecond / 240);
        top = std::max(top, double(height()));
    }
    EXPECT_NEAR(top - 0.01, 0.25 * (2.0 - 0.01), 0.01);
    for (int i = 0; i < 3000; ++i)
        stage.step(base::kTicksPerSecond / 240);
    EXPECT_NEAR(height(), 0.01f, 1e-4f); // at rest
}

TEST(FragmentsSolver, smokeIsLeftAtEqualDistancesForAnyStep)
{
    for (const base::Ticks rate : {20, 30, 60, 240}) {
        const std::vector<float> found = gaps(base::kTicksPerSecond / rate);
        EXPECT_NEAR(double(found.size() + 1), 16.0 / 0.31, 1.5) << rate;
        for (const float gap : found)
            EXPECT_NEAR(gap, 0.31f, 2e-4f) << rate;
    }
}

TEST(FragmentsSolver, whatLiesStillSmokesAtItsIdleSpeedForAnyStep)
{
    for (const base::Ticks rate : {20, 60, 240}) {
        auto def = oneFragment(0.0f);
        def->matter.gravity = 0.0f;
        def->trail.spacing = 0.1f;
        def->trail.idle = 2.0f;
        def->trail.lifetime = {100.0f, 100.0f};
        Stage stage;
        stage.add({}, std::move(def));
        while (stage.now() < 3 * base::kTicksPerSecond)
            stage.step(base::kTicksPerSecond / rate);
        EXPECT_NEAR(double(stage.look().group(1).count()), 60.0, 1.0) << rate;
        const auto ages = column(stage.look(), 1, blob::Age);
        for (size_t i = 1; i < ages.size(); ++i)
            EXPECT_NEAR(ages[i - 1] - ages[i], 0.05f, 1e-4f) << rate;
    }
}

TEST(FragmentsSolver, smokeRisesFromTheMomentItIsLeftAsItsHeatSays)
{
    auto def = oneFragment(10.0f);
    def->matter.gravity = 0.0f;
    def->trail.spacing = 0.07f;
    def->trail.lifetime = {100.0f, 100.0f};
    def->trail.temperature = 2.0f * sim::kAirTemperature; // rises with 1 g
    def->trail.mixing = def->trail.drag = def->trail.curlStrength = def->trail.inherited = 0.0f;
    Stage stage;
    stage.add({}, std::move(def));
    stage.play(31);
    const auto& snapshot = stage.look();
    const auto ages = column(snapshot, 1, blob::Age);
    ASSERT_GT(ages.size(), 60u);
    for (size_t i = 0; i < ages.size(); ++i) {
        const double left = 10.0 * (31.0 / 60.0 - double(ages[i])); // where the fragment was
        EXPECT_NEAR(column(snapshot, 1, blob::PositionY)[i],
                    left + 0.5 * 9.80665 * double(ages[i]) * double(ages[i]), 1e-4);
    }
}

TEST(FragmentsSolver, theSameBlobsAreLeftForAnyStep)
{
    const std::vector<uint64_t> fine = trailIds(base::kTicksPerSecond / 240);
    ASSERT_GT(fine.size(), 400u);
    EXPECT_EQ(std::adjacent_find(fine.begin(), fine.end()), fine.end()); // no id twice
    for (const base::Ticks rate : {30, 60}) {
        const std::vector<uint64_t> coarse = trailIds(base::kTicksPerSecond / rate);
        std::vector<uint64_t> apart;
        std::set_symmetric_difference(fine.begin(), fine.end(), coarse.begin(), coarse.end(),
                                      std::back_inserter(apart));
        EXPECT_LE(apart.size(), 20u) << rate; // at most the last one of each fragment
    }
}

TEST(FragmentsSolver, coldFragmentsLeaveNoSmoke)
{
    auto def = burst(10);
    def->temperature = {500.0f, 600.0f};
    Stage stage;
    stage.add({}, std::move(def));
    stage.play(60);
    EXPECT_EQ(stage.look().group(1).count(), 0u);
    EXPECT_EQ(stage.counters().dropped, 0u);
}

TEST(FragmentsSolver, whatDoesNotFitIsDroppedAndCounted)
{
    auto def = burst(20);
    def->trail.maxBlobs = 50;
    def->lifetime = def->trail.lifetime = {100.0f, 100.0f};
    Stage stage;
    sim::InstanceStart start;
    start.parameters.intensity = 1.5f;
    stage.add(start, std::move(def));
    stage.play(60);
    EXPECT_EQ(stage.look().group(0).count(), 20u);
    EXPECT_EQ(stage.look().group(1).count(), 50u);
    EXPECT_GT(stage.counters().dropped, 10u);
    EXPECT_EQ(stage.counters().born, stage.counters().dropped + 70u);
}

TEST(FragmentsSolver, halfTheIntensityThrowsHalfAsManyAndNoEmissionNone)
{
    for (const bool emitting : {true, false}) {
        Stage stage;
        sim::InstanceStart start;
        start.parameters.intensity = 0.5f;
        start.parameters.emitting = emitting;
        stage.add(start, burst(40));
        stage.play(10);
        EXPECT_EQ(stage.look().group(0).count(), emitting ? 20u : 0u);
    }
}

TEST(FragmentsSolver, itEndsWhenTheLastSmokeHasGone)
{
    Stage stage;
    const sim::Slot slot = stage.add({}, burst(10));
    EXPECT_FALSE(stage.world().finished(slot, stage.now()));
    stage.play(60);
    EXPECT_FALSE(stage.world().finished(slot, stage.now()));
    stage.play(240);
    EXPECT_TRUE(stage.world().finished(slot, stage.now()));
    EXPECT_EQ(stage.world().elementCount(slot), 0u);
}

TEST(FragmentsSolver, directionsFillTheShape)
{
    for (const auto shape :
         {sim::FragmentShape::Sphere, sim::FragmentShape::Hemisphere, sim::FragmentShape::Cone})
    {
        auto def = burst(400);
        def->start = 0.0f;
        def->shape = shape;
        def->angle = 0.6f;
        def->matter.gravity = def->matter.dragCoefficient = 0.0f;
        Stage stage;
        stage.add({}, std::move(def));
        stage.play(1);
        const auto& snapshot = stage.look();
        float lowest = 1.0f;
        float mean = 0.0f;
        for (uint32_t i = 0; i < snapshot.group(0).count(); ++i) {
            const glm::vec3 v{column(snapshot, 0, blob::VelocityX)[i],
                              column(snapshot, 0, blob::VelocityY)[i],
                              column(snapshot, 0, blob::VelocityZ)[i]};
            const float cosine = v.y / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
            lowest = std::min(lowest, cosine);
            mean += cosine / 400.0f;
        }
        const float limit = shape == sim::FragmentShape::Sphere       ? -1.0f
                            : shape == sim::FragmentShape::Hemisphere ? 0.0f
                                                                      : std::cos(0.6f);
        EXPECT_NEAR(lowest, limit, 0.02f);
        EXPECT_GE(lowest, limit - 1e-5f);
        EXPECT_NEAR(mean, 0.5f * (1.0f + limit), 0.06f); // uniform over the solid angle
    }
}

TEST(FragmentsSolver, glowIsFireAndTheColdRestIsNot)
{
    Stage stage;
    auto def = oneFragment(1.0f);
    def->temperature = {1500.0f, 1500.0f};
    def->size = {0.004f, 0.004f};
    stage.add({}, std::move(def));
    stage.play(1);
    EXPECT_GT(column(stage.look(), 0, blob::FireShare)[0], 0.99f);
    EXPECT_NEAR(column(stage.look(), 0, blob::Radius)[0], 0.002f, 1e-6f);
    const float first = column(stage.look(), 0, blob::Temperature)[0];
    stage.play(1200);
    EXPECT_LT(column(stage.look(), 0, blob::Temperature)[0], first - 500.0f);
    EXPECT_EQ(column(stage.look(), 0, blob::FireShare)[0], 0.0f);
}
