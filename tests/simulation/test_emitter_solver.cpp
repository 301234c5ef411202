#include "simulation/motion/blob_optics.h"
#include "tests/simulation/stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace fx;
using namespace fx::test;
namespace blob = base::blob_column;

namespace {

base::ScalarCurve line(float from, float to)
{
    const std::vector<base::CurveKey<1>> keys{{0.0f, {from}}, {1.0f, {to}}};
    return base::ScalarCurve(std::span<const base::CurveKey<1>>(keys));
}

/// Optical depth along the diameter of blob 0, integrated numerically over the quartic kernel.
double depthThroughCenter(const base::SnapshotGroup& group)
{
    const double radius = double(group.column(blob::Radius)[0]);
    const double sigma = double(group.column(blob::CrossSection)[0]);
    double depth = 0;
    const int steps = 2000;
    for (int i = 0; i < steps; ++i) {
        const double q = 2.0 * (i + 0.5) / steps - 1.0;
        const double kernel =
            105.0 / (32.0 * 3.14159265358979 * radius * radius * radius) * std::pow(1 - q * q, 2);
        depth += sigma * kernel * 2.0 * radius / steps;
    }
    return depth;
}

} // namespace

TEST(EmitterSolver, theWantedOpticalDepthIsWhatTheKernelGives)
{
    Stage stage;
    auto def = burstEmitter(1);
    def->crossSection = {1.7f, 1.7f};
    def->radius = {0.8f, 0.8f};
    def->sizeOverLife = line(0.5f, 2.0f);
    stage.add({}, std::move(def));
    stage.step();
    EXPECT_NEAR(depthThroughCenter(stage.look().group(0)), 1.7, 1e-3);
}

TEST(EmitterSolver, aGrowingBlobKeepsItsMediumAndThinsOut)
{
    Stage stage;
    auto def = burstEmitter(1);
    def->lifetime = {2.0f, 2.0f};
    def->sizeOverLife = line(1.0f, 3.0f);
    stage.add({}, std::move(def));
    stage.step();
    const double thick = depthThroughCenter(stage.look().group(0));
    const float held = stage.look().group(0).column(blob::CrossSection)[0];
    stage.play(59);
    EXPECT_EQ(stage.look().group(0).column(blob::CrossSection)[0], held);
    EXPECT_NEAR(depthThroughCenter(stage.look().group(0)), thick / 4.0,
                0.02 * thick); // radius 2 after half its life
}

TEST(EmitterSolver, aCrossSectionIsTakenAsItIs)
{
    Stage stage;
    auto def = burstEmitter(1);
    def->opticalDepthGiven = false;
    def->crossSection = {0.25f, 0.25f};
    stage.add({}, std::move(def));
    stage.step();
    EXPECT_EQ(stage.look().group(0).column(blob::CrossSection)[0], 0.25f);
}

TEST(EmitterSolver, curvesRunOverLife)
{
    Stage stage;
    auto def = burstEmitter(1);
    def->lifetime = {2.0f, 2.0f};
    def->opticalDepthGiven = false;
    def->crossSection = {4.0f, 4.0f};
    def->temperature = {sim::kAirTemperature + 1000.0f, sim::kAirTemperature + 1000.0f};
    def->opacityOverLife = line(1.0f, 0.0f);
    def->temperatureOverLife = line(1.0f, 0.0f);
    def->heat = 0.5f;
    stage.add({}, std::move(def));
    stage.play(30); // a quarter of its life
    const base::SnapshotGroup& group = stage.look().group(0);
    EXPECT_NEAR(group.column(blob::CrossSection)[0], 3.0f, 1e-4f);
    EXPECT_NEAR(group.column(blob::Temperature)[0], sim::kAirTemperature + 750.0f, 0.05f);
    EXPECT_NEAR(group.column(blob::Heat)[0], 375.0f, 0.05f);
    EXPECT_NEAR(group.column(blob::Age)[0], 0.5f, 1e-6f);
}

TEST(EmitterSolver, particlesDieAtTheEndOfTheirLife)
{
    Stage stage;
    auto def = burstEmitter(5);
    def->lifetime = {0.5f, 0.5f};
    const sim::Slot slot = stage.add({}, std::move(def));
    stage.play(29);
    EXPECT_EQ(stage.world().elementCount(slot), 5u);
    EXPECT_FALSE(stage.world().finished(slot, stage.now()));
    stage.step();
    EXPECT_EQ(stage.world().elementCount(slot), 0u);
    EXPECT_TRUE(stage.world().finished(slot, stage.now()));
    EXPECT_EQ(stage.look().group(0).count(), 0u);
}

TEST(EmitterSolver, impossibleLifetimesAreCountedAndNeverSeen)
{
    for (const float life : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
        Stage stage;
        auto def = burstEmitter(4);
        def->lifetime = {life, life};
        const sim::Slot slot = stage.add({}, std::move(def));
        stage.step();
        EXPECT_EQ(stage.counters().born, 4u) << life;
        EXPECT_EQ(stage.world().elementCount(slot), 0u) << life;
    }
    Stage stage;
    auto def = burstEmitter(4);
    def->lifetime = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()};
    const sim::Slot slot = stage.add({}, std::move(def));
    stage.play(10);
    EXPECT_EQ(stage.world().elementCount(slot), 4u);
}

TEST(EmitterSolver, aFullStoreDropsAndCounts)
{
    Stage stage;
    auto def = rateEmitter(6000.0f, 0.05f);
    def->maxParticles = 100;
    const sim::Slot slot = stage.add({}, std::move(def));
    stage.play(60);
    EXPECT_LE(stage.world().elementCount(slot), 100u);
    EXPECT_EQ(stage.counters().born, 6000u);
    EXPECT_GT(stage.counters().dropped, 3000u);
    EXPECT_LT(stage.counters().dropped, 6000u);
}

TEST(EmitterSolver, publishedIdsAscendAndStayWithTheirParticle)
{
    Stage stage;
    auto def = rateEmitter(300.0f);
    def->lifetime = {0.1f, 1.0f};
    stage.add({}, burstEmitter(1), std::move(def));
    stage.play(90);
    const base::FrameSnapshot& snapshot = stage.look();
    ASSERT_EQ(snapshot.groupCount(), 2u);
    const base::SnapshotGroup& group = snapshot.group(1);
    EXPECT_EQ(group.info().solver, 1u);
    const auto ids = group.ids();
    ASSERT_GT(ids.size(), 10u);
    for (size_t i = 0; i < ids.size(); ++i) {
        EXPECT_EQ(ids[i] >> 40, 1u);
        if (i > 0) {
            ASSERT_LT(ids[i - 1], ids[i]);
        }
    }
    // The index tells the birth: rate 300 per second, and age = now - birth.
    const double now = base::toSeconds(stage.now());
    for (size_t i = 0; i < ids.size(); ++i) {
        const double index = double(ids[i] & 0xFFFFFFFFFFull);
        const double born = now - double(group.column(blob::Age)[i]);
        ASSERT_GE(born * 300.0, index - 1e-3);
        ASSERT_LE(born * 300.0, index + 1.0);
    }
}

TEST(EmitterSolver, boundsHoldEveryBlobWithItsRadiusTightly)
{
    Stage stage;
    auto def = burstEmitter(200);
    def->shape = sim::EmitterShape::Sphere;
    def->size = {3, 0, 0};
    def->speed = {1, 5};
    def->radius = {0.2f, 0.6f};
    stage.add({}, std::move(def));
    stage.play(20);
    const base::SnapshotGroup& group = stage.look().group(0);
    const base::Bounds& bounds = group.info().bounds;
    float highest = -1e9f;
    for (uint32_t i = 0; i < group.count(); ++i) {
        const float radius = group.column(blob::Radius)[i];
        for (size_t a = 0; a < 3; ++a) {
            const float p = group.column(blob::PositionX + a)[i];
            ASSERT_LE(bounds.min[int(a)], p - radius);
            ASSERT_GE(bounds.max[int(a)], p + radius);
        }
        highest = std::max(highest, group.column(blob::PositionY)[i] + radius);
    }
    EXPECT_EQ(bounds.max.y, highest);
}

TEST(EmitterSolver, silenceEndsBirthsAndLeavesTheLiving)
{
    Stage stage;
    const sim::Slot slot = stage.add({}, rateEmitter(60.0f));
    stage.play(60);
    sim::InstanceParameters parameters;
    parameters.emitting = false;
    stage.world().setParameters(slot, parameters);
    stage.play(60);
    EXPECT_EQ(stage.world().elementCount(slot), 60u);
    parameters.emitting = true;
    parameters.intensity = 0.5f;
    stage.world().setParameters(slot, parameters);
    stage.play(60);
    EXPECT_EQ(stage.world().elementCount(slot), 90u);
}
