// What views interpolate from in the first step of an instance that is played from files.
#include "simulation/cloud/moving_cloud.h"
#include "tests/api/sight_stage.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace fx;
using namespace fx::test;

namespace {

constexpr float kSpeed = 12.0f; ///< [m/s]

/// One ball, which flies along x from 0 on.
Effect playedBall()
{
    auto cloud = std::make_unique<sim::MovingCloudDef>();
    cloud->framesPerSecond = 10.0f;
    std::vector<std::shared_ptr<const sim::MovingBalls>> frames;
    for (int i = 0; i < 4; ++i) {
        sim::MovingBall ball;
        ball.ball.center.x = 0.1f * kSpeed * float(i);
        ball.ball.radius = ball.ball.crossSection = 1.0f;
        ball.velocity.x = kSpeed;
        frames.push_back(std::make_shared<const sim::MovingBalls>(sim::MovingBalls{ball}));
    }
    cloud->setFrames(std::move(frames));
    auto effect = emptyEffect();
    effect->solvers.push_back(std::move(cloud));
    return effect;
}

/// [m] Place of the first ball of an instance in the two snapshots that views interpolate; NaN where it is
/// not there.
std::array<float, 2> placesOf(scene::Scene& scene, scene::LocalId id)
{
    std::array<float, 2> places{NAN, NAN};
    const scene::Presentation shown = scene.acquire();
    for (size_t k = 0; k < 2; ++k) {
        const base::FrameSnapshot* const snapshot = k == 0 ? shown.snapshots.older : shown.snapshots.newer;
        for (size_t g = 0; snapshot && g < snapshot->groupCount(); ++g)
            if (const base::SnapshotGroup& group = snapshot->group(g); group.info().instance == id)
                places[k] = group.column(base::blob_column::PositionX)[0];
    }
    scene.release(shown.snapshots);
    return places;
}

/// [tick] Local time that passed in the last step of an instance, by its first group in the newer snapshot.
base::Ticks stepOf(scene::Scene& scene, scene::LocalId id)
{
    base::Ticks step = -1;
    const scene::Presentation shown = scene.acquire();
    for (size_t g = 0; g < shown.snapshots.newer->groupCount() && step < 0; ++g)
        if (const base::GroupInfo& info = shown.snapshots.newer->group(g).info(); info.instance == id)
            step = info.step;
    scene.release(shown.snapshots);
    return step;
}

constexpr float kWay = kSpeed / 60.0f; ///< [m] in a step

} // namespace

TEST(PlayedStart, theFirstStepBeginsWithTheFirstFrame)
{
    SightStage stage(neverCulled());
    const auto now = stage.add(playedBall(), kAhead);
    const auto later = stage.add(playedBall(), kAhead, 1, 3 * kStep);
    stage.play(1);
    EXPECT_NEAR(placesOf(stage.scene(), now)[0], 0.0f, 1e-6f);
    EXPECT_NEAR(placesOf(stage.scene(), now)[1], kWay, 1e-6f);
    stage.play(2);
    EXPECT_TRUE(std::isnan(placesOf(stage.scene(), later)[1]));
    stage.play(1);
    EXPECT_NEAR(placesOf(stage.scene(), later)[0], 0.0f, 1e-6f);
    EXPECT_NEAR(placesOf(stage.scene(), later)[1], kWay, 1e-6f);
    EXPECT_NEAR(placesOf(stage.scene(), now)[0], 3.0f * kWay, 1e-5f) << "others are where they were";
    EXPECT_NEAR(placesOf(stage.scene(), now)[1], 4.0f * kWay, 1e-5f);
}

TEST(PlayedStart, aStartWithinAStepIsAtItsMoment)
{
    SightStage stage(neverCulled());
    const auto id = stage.add(playedBall(), kAhead, 1, 5 * kStep / 2);
    stage.play(3);
    const auto [before, after] = placesOf(stage.scene(), id);
    EXPECT_NEAR(before, -0.5f * kWay, 1e-6f);
    EXPECT_NEAR(after, 0.5f * kWay, 1e-6f);
}

TEST(PlayedStart, theFirstStepMayBeTheLastOfAnUpdate)
{
    for (const int start : {0, 2, 3}) {
        SightStage stage(neverCulled());
        const auto id = stage.add(playedBall(), kAhead, 1, start * kStep);
        stage.scene().update(4.0 / 60.0);
        EXPECT_NEAR(placesOf(stage.scene(), id)[0], float(3 - start) * kWay, 1e-5f) << start;
        EXPECT_NEAR(placesOf(stage.scene(), id)[1], float(4 - start) * kWay, 1e-5f) << start;
    }
}

TEST(PlayedStart, stepsAreInTheTimeOfTheInstance)
{
    SightStage stage(neverCulled());
    const auto plain = stage.add(playedBall(), kAhead), changed = stage.add(playedBall(), kAhead);
    stage.play(2);
    EXPECT_EQ(stepOf(stage.scene(), changed), kStep);
    for (const uint32_t rate : {2 * sim::kNormalRate, sim::kNormalRate / 4, 0u, 0u, sim::kNormalRate}) {
        stage.scene().setRate(changed, rate);
        for (int i = 0; i < 3; ++i) {
            const float from = placesOf(stage.scene(), changed)[1];
            stage.play(1);
            EXPECT_EQ(stepOf(stage.scene(), changed), kStep * base::Ticks(rate) / sim::kNormalRate) << rate;
            EXPECT_NEAR(placesOf(stage.scene(), changed)[1] - from, kWay * float(rate) / sim::kNormalRate,
                        1e-5f);
            EXPECT_EQ(stepOf(stage.scene(), plain), kStep);
        }
    }
}
