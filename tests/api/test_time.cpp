// Whatever a host calls the time of a frame, a scene stays finite and says what it left out.
#include "foundation/math/bits.h"
#include "tests/api/api_fixture.h"

#include <limits>

using TimeApi = fx::test::ApiTest;
using fx::test::kFrame;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// True when all floats of the newest step are.
bool isFinite(FxScene* scene)
{
    FxSnapshotId snapshot{};
    EXPECT_EQ(fxScene_AcquireSnapshot(scene, &snapshot), FX_OK);
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(fxScene_GetSnapshotInfo(scene, snapshot, &info), FX_OK);
    bool finite = true;
    for (uint32_t g = 0; g < info.groupsNewer; ++g) {
        FxSnapshotGroup group{};
        group.structSize = sizeof group;
        EXPECT_EQ(fxScene_GetSnapshotGroup(scene, snapshot, FX_SNAPSHOT_NEWER, g, &group), FX_OK);
        for (uint32_t c = 0; c < group.columnCount; ++c) {
            FxSnapshotColumn column{};
            column.structSize = sizeof column;
            EXPECT_EQ(fxScene_GetSnapshotColumn(scene, snapshot, FX_SNAPSHOT_NEWER, g, c, &column), FX_OK);
            if (column.values) // whole numbers such as identities have none
                finite = finite && fx::base::allFinite(column.values, int(column.count));
        }
    }
    EXPECT_EQ(fxScene_ReleaseSnapshot(scene, snapshot), FX_OK);
    return finite;
}

} // namespace

TEST_F(TimeApi, noFrameTimeHarmsAnExplosion)
{
    FxPresetId explosion{};
    ASSERT_EQ(fxLoadPresetLibrary(context_, fx::test::kLargeEffect, &explosion), FX_OK);
    FxInstanceDef def = instanceDef();
    def.preset = explosion;
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    for (const double dt : {1.0, 0.0, -0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e-12, 5e-324,
                            1e30, 1e300, kInfinity, -kInfinity, -1e-300})
        for (int frame = 0; frame < 10; ++frame) {
            const FxSceneStatistics before = statistics();
            const uint64_t whole = simulationHash();
            const bool legal = dt >= 0.0 && dt < kInfinity;
            ASSERT_EQ(fxScene_Update(scene_, dt), legal ? FX_OK : FX_ERROR_INVALID_ARGUMENT) << dt;
            const FxSceneStatistics after = statistics();
            EXPECT_EQ(after.refusedUpdates, before.refusedUpdates + (legal ? 0 : 1)) << dt;
            EXPECT_LE(after.steps, before.steps + 4) << dt;
            EXPECT_GE(after.droppedTicks, before.droppedTicks) << dt; // it does not overflow
            EXPECT_GE(after.debtTicks, before.debtTicks) << dt;
            EXPECT_EQ(simulationHash() == whole, after.steps == before.steps) << dt;
        }
    EXPECT_TRUE(isFinite(scene_));
    EXPECT_GT(statistics().particles, 0u);
}

TEST_F(TimeApi, tinyFramesAddUpToSteps)
{
    const FxSceneStatistics before = statistics();
    for (int i = 0; i < 100'000; ++i)
        ASSERT_EQ(fxScene_Update(scene_, 1e-7), FX_OK); // 70.56 ticks: none of it may be lost
    const double ticks = double(statistics().nowTick - before.nowTick);
    EXPECT_NEAR(ticks, 0.01 * double(FX_TICKS_PER_SECOND), 1.0);
}

TEST_F(TimeApi, framesThatAlternateBetweenShortAndFarTooLongAreClampedAndCounted)
{
    addFountain();
    for (int i = 0; i < 20; ++i) {
        ASSERT_EQ(fxScene_Update(scene_, 0.001), FX_OK);
        ASSERT_EQ(fxScene_Update(scene_, 0.250), FX_OK);
    }
    const FxSceneStatistics now = statistics();
    const double simulated = 20 * (0.001 + 1.0 / 15.0);
    EXPECT_NEAR(double(now.nowTick) / double(FX_TICKS_PER_SECOND), simulated, 1e-6);
    EXPECT_NEAR(double(now.droppedTicks) / double(FX_TICKS_PER_SECOND), 20 * (0.250 - 1.0 / 15.0), 1e-6);
    EXPECT_TRUE(isFinite(scene_));
}
