#include "tests/api/api_fixture.h"

#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

using fx::test::kFrame;

namespace {

/// A scene with a fountain that has run for half a second, and a snapshot of it.
class SnapshotApi : public fx::test::ApiTest
{
protected:
    SnapshotApi()
    {
        instance_ = addFountain();
        for (int frame = 0; frame < 30; ++frame)
            EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
        EXPECT_EQ(fxScene_Update(scene_, 0.25 * kFrame), FX_OK);
        EXPECT_EQ(fxScene_AcquireSnapshot(scene_, &snapshot_), FX_OK);
    }
    ~SnapshotApi() override { fxScene_ReleaseSnapshot(scene_, snapshot_); }

    FxSnapshotColumn column(const char* name, FxSnapshotStep step = FX_SNAPSHOT_NEWER) const
    {
        FxSnapshotColumn column{};
        column.structSize = sizeof column;
        EXPECT_EQ(fxScene_FindSnapshotColumn(scene_, snapshot_, step, 0, name, &column), FX_OK)
            << fxGetLastErrorMessage();
        return column;
    }
    FxSnapshotGroup group(FxSnapshotStep step = FX_SNAPSHOT_NEWER) const
    {
        FxSnapshotGroup group{};
        group.structSize = sizeof group;
        EXPECT_EQ(fxScene_GetSnapshotGroup(scene_, snapshot_, step, 0, &group), FX_OK);
        return group;
    }

    FxInstanceId instance_{};
    FxSnapshotId snapshot_{};
};

} // namespace

TEST_F(SnapshotApi, itHoldsTheLastTwoStepsAndTheMomentBetween)
{
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    ASSERT_EQ(fxScene_GetSnapshotInfo(scene_, snapshot_, &info), FX_OK);
    EXPECT_EQ(info.groupsNewer, 1u);
    EXPECT_EQ(info.groupsOlder, 1u);
    EXPECT_EQ(info.tickNewer, 30 * (FX_TICKS_PER_SECOND / 60));
    EXPECT_EQ(info.tickOlder, 29 * (FX_TICKS_PER_SECOND / 60));
    EXPECT_NEAR(info.interpolation, 0.25, 1e-6);
}

TEST_F(SnapshotApi, alsoAfterAFrameOfManyStepsTheTwoAreNeighbors)
{
    ASSERT_EQ(fxScene_Update(scene_, 4 * kFrame), FX_OK);
    FxSnapshotId later{};
    ASSERT_EQ(fxScene_AcquireSnapshot(scene_, &later), FX_OK);
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    ASSERT_EQ(fxScene_GetSnapshotInfo(scene_, later, &info), FX_OK);
    EXPECT_EQ(info.tickNewer, 34 * (FX_TICKS_PER_SECOND / 60));
    EXPECT_EQ(info.tickOlder, 33 * (FX_TICKS_PER_SECOND / 60));
    EXPECT_EQ(fxScene_ReleaseSnapshot(scene_, later), FX_OK);
}

TEST_F(SnapshotApi, aGroupSaysWhoseParticlesItHasAndItsBoundsHoldThem)
{
    const FxSnapshotGroup found = group();
    EXPECT_STREQ(found.kind, "blob");
    EXPECT_EQ(found.instance.bits, instance_.bits);
    EXPECT_NEAR(double(found.count), 30.0, 1.0);
    const float* coordinates[3] = {column("x").values, column("y").values, column("z").values};
    const float* radius = column("radius").values;
    for (uint32_t i = 0; i < found.count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(coordinates[axis][i] - radius[i], found.boundsMin[axis] - 1e-5f);
            EXPECT_LE(coordinates[axis][i] + radius[i], found.boundsMax[axis] + 1e-5f);
        }
        if (i > 0) {
            EXPECT_LT(found.ids[i - 1], found.ids[i]);
        }
    }
    EXPECT_STREQ(column("radius").unit, "m");
}

TEST_F(SnapshotApi, particlesKeepTheirIdsFromStepToStep)
{
    const FxSnapshotGroup newer = group();
    const FxSnapshotGroup older = group(FX_SNAPSHOT_OLDER);
    ASSERT_GT(older.count, 0u);
    const float* yOld = column("y", FX_SNAPSHOT_OLDER).values;
    const float* vOld = column("vy", FX_SNAPSHOT_OLDER).values;
    const float* yNew = column("y").values;
    for (uint32_t i = 0, j = 0; i < older.count; ++i) {
        while (j < newer.count && newer.ids[j] < older.ids[i])
            ++j;
        if (j < newer.count && newer.ids[j] == older.ids[i]) {
            EXPECT_NEAR(yNew[j], yOld[i] + vOld[i] * float(kFrame), 0.1f); // it moved, it did not jump
        }
    }
}

TEST_F(SnapshotApi, columnsAreFoundByPositionAsByName)
{
    const FxSnapshotGroup found = group();
    for (uint32_t i = 0; i < found.columnCount; ++i) {
        FxSnapshotColumn byPosition{};
        byPosition.structSize = sizeof byPosition;
        ASSERT_EQ(fxScene_GetSnapshotColumn(scene_, snapshot_, FX_SNAPSHOT_NEWER, 0, i, &byPosition), FX_OK);
        EXPECT_EQ(byPosition.values, column(byPosition.name).values);
        EXPECT_EQ(byPosition.count, found.count);
    }
}

TEST_F(SnapshotApi, whatIsHeldDoesNotChangeWhileTheSceneGoesOn)
{
    const FxSnapshotColumn y = column("y");
    const std::vector<float> before(y.values, y.values + y.count);
    for (int frame = 0; frame < 50; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    EXPECT_EQ(column("y").values, y.values);
    EXPECT_EQ(std::memcmp(before.data(), y.values, before.size() * sizeof(float)), 0);
}

TEST_F(SnapshotApi, aReleasedOrForeignOrNullIdIsRefused)
{
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    FxSnapshotColumn column{};
    column.structSize = sizeof column;
    FxSnapshotGroup group{};
    group.structSize = sizeof group;
    const auto all = [&](FxScene* scene, FxSnapshotId id, FxResult wanted) {
        EXPECT_EQ(fxScene_GetSnapshotInfo(scene, id, &info), wanted);
        EXPECT_EQ(fxScene_GetSnapshotGroup(scene, id, FX_SNAPSHOT_NEWER, 0, &group), wanted);
        EXPECT_EQ(fxScene_GetSnapshotColumn(scene, id, FX_SNAPSHOT_NEWER, 0, 0, &column), wanted);
        EXPECT_EQ(fxScene_FindSnapshotColumn(scene, id, FX_SNAPSHOT_NEWER, 0, "x", &column), wanted);
        EXPECT_EQ(fxScene_ReleaseSnapshot(scene, id), wanted);
    };
    all(nullptr, snapshot_, FX_ERROR_INVALID_ARGUMENT);
    all(scene_, FxSnapshotId{0}, FX_ERROR_STALE_ID);
    all(scene_, FxSnapshotId{instance_.bits}, FX_ERROR_STALE_ID);
    ASSERT_EQ(fxScene_ReleaseSnapshot(scene_, snapshot_), FX_OK);
    all(scene_, snapshot_, FX_ERROR_STALE_ID);
}

TEST_F(SnapshotApi, whatIsOutOfRangeIsRefused)
{
    FxSnapshotGroup group{};
    group.structSize = sizeof group;
    FxSnapshotColumn column{};
    column.structSize = sizeof column;
    const FxSnapshotStep never = FxSnapshotStep(7);
    EXPECT_EQ(fxScene_GetSnapshotGroup(scene_, snapshot_, never, 0, &group), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetSnapshotGroup(scene_, snapshot_, FX_SNAPSHOT_NEWER, 1, &group),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetSnapshotGroup(scene_, snapshot_, FX_SNAPSHOT_NEWER, 0, nullptr),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetSnapshotColumn(scene_, snapshot_, FX_SNAPSHOT_NEWER, 0, 1000, &column),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_FindSnapshotColumn(scene_, snapshot_, FX_SNAPSHOT_NEWER, 0, nullptr, &column),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_FindSnapshotColumn(scene_, snapshot_, FX_SNAPSHOT_NEWER, 0, "mood", &column),
              FX_ERROR_NOT_FOUND);
    group.structSize = 0;
    EXPECT_EQ(fxScene_GetSnapshotGroup(scene_, snapshot_, FX_SNAPSHOT_NEWER, 0, &group), FX_ERROR_VERSION);
    EXPECT_EQ(fxScene_AcquireSnapshot(nullptr, &snapshot_), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_AcquireSnapshot(scene_, nullptr), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(SnapshotApi, theSeventeenthIsRefusedUntilOneIsReleased)
{
    std::vector<FxSnapshotId> held(15);
    for (FxSnapshotId& id : held)
        ASSERT_EQ(fxScene_AcquireSnapshot(scene_, &id), FX_OK);
    FxSnapshotId one{};
    EXPECT_EQ(fxScene_AcquireSnapshot(scene_, &one), FX_ERROR_CAPACITY);
    ASSERT_EQ(fxScene_ReleaseSnapshot(scene_, held.back()), FX_OK);
    EXPECT_EQ(fxScene_AcquireSnapshot(scene_, &held.back()), FX_OK);
    for (const FxSnapshotId id : held)
        ASSERT_EQ(fxScene_ReleaseSnapshot(scene_, id), FX_OK);
}

TEST_F(SnapshotApi, anotherThreadReadsWhileTheSceneThreadUpdates)
{
    std::thread reader([this] {
        for (int i = 0; i < 500; ++i) {
            FxSnapshotId id{};
            ASSERT_EQ(fxScene_AcquireSnapshot(scene_, &id), FX_OK);
            FxSnapshotColumn y{};
            y.structSize = sizeof y;
            ASSERT_EQ(fxScene_FindSnapshotColumn(scene_, id, FX_SNAPSHOT_NEWER, 0, "y", &y), FX_OK);
            float sum = 0;
            for (uint32_t k = 0; k < y.count; ++k)
                sum += y.values[k];
            EXPECT_TRUE(std::isfinite(sum));
            ASSERT_EQ(fxScene_ReleaseSnapshot(scene_, id), FX_OK);
        }
    });
    for (int frame = 0; frame < 500; ++frame)
        EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    reader.join();
}

TEST(EmptyScene, hasASnapshotWithoutGroupsFromTheStart)
{
    FxContext* context = nullptr;
    const FxContextDef contextDef = fxDefaultContextDef();
    ASSERT_EQ(fxCreateContext(&contextDef, &context), FX_OK);
    FxScene* scene = nullptr;
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
    FxSnapshotId id{};
    ASSERT_EQ(fxScene_AcquireSnapshot(scene, &id), FX_OK);
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    ASSERT_EQ(fxScene_GetSnapshotInfo(scene, id, &info), FX_OK);
    EXPECT_EQ(info.groupsNewer, 0u);
    EXPECT_EQ(info.groupsOlder, 0u);
    EXPECT_EQ(info.tickNewer, 0);
    EXPECT_EQ(fxDestroyContext(context), FX_OK); // a held snapshot does not keep it
}

TEST_F(SnapshotApi, particlesAreBornWhereTheirShapeStandsHoweverItIsMade)
{
    for (const char* shape :
         {R"("shape": "sphere", "size": 0.3)", R"("shape": "sphere", "size": 0.3, "surface": true)",
          R"("shape": "cone", "size": 0.3, "axis": [1, 1, 0])", R"("shape": "line", "size": 0.3)"})
    {
        const std::string text = std::string(R"({"version": 1, "emitters": [{"position": [3, 46, -5], )") +
                                 shape +
                                 R"(, "emission": {"bursts": [{"time": 0, "count": 50}]}, "radius": 0.01,
            "forces": {"gravity": 0}, "appearance": {"kind": "sprite"}}]})";
        FxScene* scene = nullptr;
        const FxSceneDef def = fxDefaultSceneDef();
        ASSERT_EQ(fxCreateScene(context_, &def, &scene), FX_OK);
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = fx::test::loadText(context_, text.c_str());
        FxInstanceId id{};
        ASSERT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK);
        for (int i = 0; i < 3; ++i)
            ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
        FxSnapshotId snapshot{};
        ASSERT_EQ(fxScene_AcquireSnapshot(scene, &snapshot), FX_OK);
        FxSnapshotGroup born{};
        born.structSize = sizeof born;
        ASSERT_EQ(fxScene_GetSnapshotGroup(scene, snapshot, FX_SNAPSHOT_NEWER, 0, &born), FX_OK);
        const float center[3] = {3, 46, -5};
        for (int a = 0; a < 3; ++a) {
            EXPECT_GT(born.boundsMin[a], center[a] - 0.35f) << shape;
            EXPECT_LT(born.boundsMax[a], center[a] + 0.35f) << shape;
            EXPECT_LE(born.boundsMin[a], born.boundsMax[a]) << shape;
        }
        EXPECT_EQ(fxScene_ReleaseSnapshot(scene, snapshot), FX_OK);
        EXPECT_EQ(fxDestroyScene(scene), FX_OK);
    }
}
