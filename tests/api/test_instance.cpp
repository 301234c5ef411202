#include "tests/api/api_fixture.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using fx::test::kFrame;
using InstanceApi = fx::test::ApiTest;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// Positions of the particles of `instance` after the last step, local.
std::vector<float> positionsOf(FxScene* scene, FxInstanceId instance)
{
    std::vector<float> positions;
    FxSnapshotId snapshot{};
    EXPECT_EQ(fxScene_AcquireSnapshot(scene, &snapshot), FX_OK);
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(fxScene_GetSnapshotInfo(scene, snapshot, &info), FX_OK);
    for (uint32_t i = 0; i < info.groupsNewer; ++i) {
        FxSnapshotGroup group{};
        group.structSize = sizeof group;
        EXPECT_EQ(fxScene_GetSnapshotGroup(scene, snapshot, FX_SNAPSHOT_NEWER, i, &group), FX_OK);
        if (group.instance.bits != instance.bits)
            continue;
        for (const char* name : {"x", "y", "z"}) {
            FxSnapshotColumn column{};
            column.structSize = sizeof column;
            EXPECT_EQ(fxScene_FindSnapshotColumn(scene, snapshot, FX_SNAPSHOT_NEWER, i, name, &column),
                      FX_OK);
            positions.insert(positions.end(), column.values, column.values + column.count);
        }
    }
    EXPECT_EQ(fxScene_ReleaseSnapshot(scene, snapshot), FX_OK);
    return positions;
}

} // namespace

TEST_F(InstanceApi, aDefinitionOutOfRangeIsRefusedAndTheMessageNamesTheMember)
{
    const auto refuse = [this](const char* member, FxResult wanted, void (*spoil)(FxInstanceDef&)) {
        FxInstanceDef def = instanceDef();
        spoil(def);
        FxInstanceId id{99};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), wanted) << member;
        EXPECT_NE(std::strstr(fxGetLastErrorMessage(), member), nullptr) << fxGetLastErrorMessage();
        EXPECT_EQ(id.bits, 99u);
    };
    constexpr FxResult kInvalid = FX_ERROR_INVALID_ARGUMENT;
    refuse("structSize", FX_ERROR_VERSION, [](FxInstanceDef& def) { def.structSize = 12; });
    refuse("preset", FX_ERROR_STALE_ID, [](FxInstanceDef& def) { def.preset.bits = 0; });
    refuse("preset", FX_ERROR_STALE_ID, [](FxInstanceDef& def) { def.preset.bits ^= uint64_t(1) << 30; });
    refuse("position", kInvalid, [](FxInstanceDef& def) { def.position[1] = double(kNan); });
    refuse("position", kInvalid, [](FxInstanceDef& def) { def.position[2] = 1.1e9; });
    refuse("rotation", kInvalid, [](FxInstanceDef& def) { def.rotation[0] = kNan; });
    refuse("rotation", kInvalid, [](FxInstanceDef& def) { def.rotation[3] = 1.1f; });
    refuse("rotation", kInvalid, [](FxInstanceDef& def) { def.rotation[3] = 0.0f; });
    refuse("scale", kInvalid, [](FxInstanceDef& def) { def.scale = 0.0f; });
    refuse("scale", kInvalid, [](FxInstanceDef& def) { def.scale = kInf; });
    refuse("startTick", kInvalid, [](FxInstanceDef& def) { def.startTick = -1; });
    refuse("startTick", kInvalid,
           [](FxInstanceDef& def) { def.startTick = std::numeric_limits<int64_t>::max(); });
    refuse("intensity", kInvalid, [](FxInstanceDef& def) { def.intensity = -0.1f; });
    refuse("intensity", kInvalid, [](FxInstanceDef& def) { def.intensity = kNan; });
    refuse("wind", kInvalid, [](FxInstanceDef& def) { def.wind[2] = kInf; });
    refuse("emitting", kInvalid, [](FxInstanceDef& def) { def.emitting = 2; });
    refuse("destroyWhenFinished", kInvalid, [](FxInstanceDef& def) { def.destroyWhenFinished = 2; });
    EXPECT_EQ(statistics().instances, 0u);
}

TEST_F(InstanceApi, allInstancesEndAtOnceAndTheSceneGoesOnAsAnEmptyOne)
{
    std::vector<FxInstanceId> ids;
    for (int i = 0; i < 20; ++i)
        ids.push_back(addFountain());
    for (int i = 0; i < 30; ++i)
        ASSERT_EQ(fxScene_Update(scene_, fx::test::kFrame), FX_OK);
    ASSERT_EQ(fxScene_DestroyAllInstances(scene_), FX_OK) << fxGetLastErrorMessage();
    for (const FxInstanceId id : ids)
        EXPECT_EQ(fxScene_IsValid(scene_, id), 0u);
    ASSERT_EQ(fxScene_Update(scene_, fx::test::kFrame), FX_OK);
    EXPECT_EQ(statistics().instances, 0u);
    EXPECT_EQ(statistics().particles, 0u);
    EXPECT_EQ(fxScene_DestroyAllInstances(scene_), FX_OK); // nothing is left to do
    EXPECT_EQ(fxScene_IsValid(scene_, addFountain()), 1u);
}

TEST_F(InstanceApi, nullAndStaleAndForeignIdsAreRefusedByEveryFunction)
{
    const FxInstanceId live = addFountain();
    const FxInstanceId dead = addFountain();
    ASSERT_EQ(fxScene_DestroyInstance(scene_, dead), FX_OK);
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    FxScene* other = nullptr;
    ASSERT_EQ(fxCreateScene(context_, &sceneDef, &other), FX_OK);
    const double position[3] = {0, 0, 0};
    const float rotation[4] = {0, 0, 0, 1};
    const FxInstanceParameters parameters = fxDefaultInstanceParameters();
    FxInstanceState state;

    const auto all = [&](FxScene* scene, FxInstanceId id, FxResult wanted) {
        EXPECT_EQ(fxScene_SetTransform(scene, id, position, rotation, 1.0f), wanted);
        EXPECT_EQ(fxScene_SetParameters(scene, id, &parameters), wanted);
        EXPECT_EQ(fxScene_GetInstanceState(scene, id, &state, nullptr), wanted);
        EXPECT_EQ(fxScene_IsValid(scene, id), 0u);
        EXPECT_EQ(fxScene_DestroyInstance(scene, id), wanted);
    };
    all(nullptr, live, FX_ERROR_INVALID_ARGUMENT);
    all(scene_, dead, FX_ERROR_STALE_ID);
    all(scene_, FxInstanceId{0}, FX_ERROR_STALE_ID);
    all(scene_, FxInstanceId{fountain_.bits}, FX_ERROR_STALE_ID);
    all(scene_, FxInstanceId{~uint64_t(0)}, FX_ERROR_STALE_ID);
    all(other, live, FX_ERROR_STALE_ID);
    EXPECT_EQ(fxScene_IsValid(scene_, live), 1u);
    EXPECT_EQ(fxDestroyScene(other), FX_OK);

    EXPECT_EQ(fxScene_DestroyAllInstances(nullptr), FX_ERROR_INVALID_ARGUMENT);
    const FxInstanceDef def = instanceDef();
    FxInstanceId id;
    EXPECT_EQ(fxScene_CreateInstance(nullptr, &def, &id), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_CreateInstance(scene_, nullptr, &id), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_CreateInstance(scene_, &def, nullptr), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(InstanceApi, transformsAndParametersOutOfRangeChangeNothing)
{
    const FxInstanceId id = addFountain();
    const double position[3] = {1, 2, 3};
    const float rotation[4] = {0, 0, 0, 1};
    const double nowhere[3] = {0, double(kNan), 0};
    const float skewed[4] = {0, 0.5f, 0, 1};
    EXPECT_EQ(fxScene_SetTransform(scene_, id, nullptr, rotation, 1), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetTransform(scene_, id, position, nullptr, 1), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetTransform(scene_, id, nowhere, rotation, 1), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetTransform(scene_, id, position, skewed, 1), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetTransform(scene_, id, position, rotation, -1), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetParameters(scene_, id, nullptr), FX_ERROR_INVALID_ARGUMENT);
    FxInstanceParameters parameters = fxDefaultInstanceParameters();
    parameters.intensity = 1e9f;
    EXPECT_EQ(fxScene_SetParameters(scene_, id, &parameters), FX_ERROR_INVALID_ARGUMENT);
    parameters = fxDefaultInstanceParameters();
    parameters.structSize = 2;
    EXPECT_EQ(fxScene_SetParameters(scene_, id, &parameters), FX_ERROR_VERSION);
    ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    EXPECT_NEAR(double(statistics().born), 1.0, 1.0);
}

TEST_F(InstanceApi, aTransformIsSeenInTheNextStepAndNotBefore)
{
    const FxInstanceId id = addFountain();
    ASSERT_EQ(fxScene_Update(scene_, 2 * kFrame), FX_OK);
    const uint64_t before = hash();
    const double position[3] = {1e5, 2, 3};
    const float rotation[4] = {0, 0.70710678f, 0, 0.70710678f};
    ASSERT_EQ(fxScene_SetTransform(scene_, id, position, rotation, 2.0f), FX_OK);
    EXPECT_EQ(hash(), before);
    ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    FxSnapshotId snapshot;
    ASSERT_EQ(fxScene_AcquireSnapshot(scene_, &snapshot), FX_OK);
    FxSnapshotGroup group{};
    group.structSize = sizeof group;
    ASSERT_EQ(fxScene_GetSnapshotGroup(scene_, snapshot, FX_SNAPSHOT_NEWER, 0, &group), FX_OK);
    EXPECT_EQ(group.position[0], 1e5);
    EXPECT_EQ(group.scale, 2.0f);
    EXPECT_NEAR(group.rotation[1], 0.70710678f, 1e-6f);
    EXPECT_NEAR(group.rotation[3], 0.70710678f, 1e-6f);
    EXPECT_EQ(fxScene_ReleaseSnapshot(scene_, snapshot), FX_OK);
}

TEST_F(InstanceApi, withoutEmissionNothingIsBornAndWhatExistsLivesOn)
{
    const FxInstanceId id = addFountain();
    for (int frame = 0; frame < 30; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    FxInstanceParameters parameters = fxDefaultInstanceParameters();
    parameters.emitting = 0;
    ASSERT_EQ(fxScene_SetParameters(scene_, id, &parameters), FX_OK);
    const FxSceneStatistics before = statistics();
    for (int frame = 0; frame < 10; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    EXPECT_EQ(statistics().born, before.born);
    EXPECT_EQ(statistics().particles, before.particles);
}

TEST_F(InstanceApi, creatingASecondInstanceLeavesTheFirstBitForBitAlone)
{
    FxInstanceDef def = instanceDef();
    FxInstanceId a{}, b{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &a), FX_OK);
    for (int frame = 0; frame < 40; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    const std::vector<float> alone = positionsOf(scene_, a);
    ASSERT_EQ(fxScene_DestroyInstance(scene_, a), FX_OK);

    const FxSceneDef sceneDef = fxDefaultSceneDef();
    FxScene* second = nullptr;
    ASSERT_EQ(fxCreateScene(context_, &sceneDef, &second), FX_OK);
    ASSERT_EQ(fxScene_CreateInstance(second, &def, &a), FX_OK);
    for (int frame = 0; frame < 40; ++frame) {
        def.seed = 1000 + uint64_t(frame);
        if (frame % 5 == 2) {
            ASSERT_EQ(fxScene_CreateInstance(second, &def, &b), FX_OK);
        } else if (frame % 5 == 4) {
            ASSERT_EQ(fxScene_DestroyInstance(second, b), FX_OK);
        }
        ASSERT_EQ(fxScene_Update(second, kFrame), FX_OK);
    }
    const std::vector<float> accompanied = positionsOf(second, a);
    ASSERT_FALSE(alone.empty());
    ASSERT_EQ(alone.size(), accompanied.size());
    EXPECT_EQ(std::memcmp(alone.data(), accompanied.data(), alone.size() * sizeof(float)), 0);
    EXPECT_EQ(fxDestroyScene(second), FX_OK);
}

TEST_F(InstanceApi, aFullSceneRefusesAndTakesAgainAfterARemoval)
{
    FxSceneDef sceneDef = fxDefaultSceneDef();
    sceneDef.maxInstances = 2;
    FxScene* scene = nullptr;
    ASSERT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_OK);
    const FxInstanceDef def = instanceDef();
    FxInstanceId first{}, id{};
    ASSERT_EQ(fxScene_CreateInstance(scene, &def, &first), FX_OK);
    ASSERT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK);
    EXPECT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_ERROR_CAPACITY);
    ASSERT_EQ(fxScene_DestroyInstance(scene, first), FX_OK);
    EXPECT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK);
    EXPECT_EQ(fxDestroyScene(scene), FX_OK);
}
