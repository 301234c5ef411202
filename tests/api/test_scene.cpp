#include "tests/api/api_fixture.h"

#include <cmath>
#include <limits>
#include <vector>

using fx::test::burstPreset;
using fx::test::kFrame;
using fx::test::loadText;
using SceneApi = fx::test::ApiTest;

namespace {

const double kNotNumbers[] = {std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()};

} // namespace

TEST_F(SceneApi, aDefinitionOutOfRangeIsRefused)
{
    const auto create = [this](void (*spoil)(FxSceneDef&)) {
        FxSceneDef def = fxDefaultSceneDef();
        spoil(def);
        FxScene* scene = nullptr;
        const FxResult result = fxCreateScene(context_, &def, &scene);
        EXPECT_EQ(scene, nullptr);
        return result;
    };
    EXPECT_EQ(create([](FxSceneDef& def) { def.structSize = 1; }), FX_ERROR_VERSION);
    EXPECT_EQ(create([](FxSceneDef& def) { def.stepTicks = 0; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(create([](FxSceneDef& def) { def.stepTicks = FX_TICKS_PER_SECOND + 1; }),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(create([](FxSceneDef& def) { def.maxFrameTicks = def.stepTicks - 1; }),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(create([](FxSceneDef& def) { def.gravity[1] = NAN; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(create([](FxSceneDef& def) { def.hasGround = 2; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(create([](FxSceneDef& def) { def.maxInstances = 0; }), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(create([](FxSceneDef& def) { def.maxInstances = 1u << 24; }), FX_ERROR_INVALID_ARGUMENT);
    const FxSceneDef def = fxDefaultSceneDef();
    FxScene* scene = nullptr;
    EXPECT_EQ(fxCreateScene(nullptr, &def, &scene), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxCreateScene(context_, nullptr, &scene), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxCreateScene(context_, &def, nullptr), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(SceneApi, nullIsRefusedByEveryFunction)
{
    FxSceneStatistics statistics{};
    uint64_t hash = 0;
    EXPECT_EQ(fxDestroyScene(nullptr), FX_OK);
    EXPECT_EQ(fxScene_AdoptThread(nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_Update(nullptr, kFrame), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetStatistics(nullptr, &statistics), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetStatistics(scene_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetStatistics(scene_, &statistics), FX_ERROR_VERSION);
    EXPECT_EQ(fxScene_GetStateHash(nullptr, &hash), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetStateHash(scene_, nullptr), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(SceneApi, timeThatIsNoTimeIsRefusedAndCountedAndNothingAdvances)
{
    addFountain();
    ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    const FxSceneStatistics before = statistics();
    const uint64_t hashBefore = hash();
    for (const double dt : kNotNumbers)
        EXPECT_EQ(fxScene_Update(scene_, dt), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_Update(scene_, -1e-300), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(statistics().refusedUpdates, 4u);
    EXPECT_EQ(statistics().nowTick, before.nowTick);
    EXPECT_EQ(hash(), hashBefore);
}

TEST_F(SceneApi, zeroTimeChangesNothing)
{
    addFountain();
    ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    const uint64_t before = hash();
    ASSERT_EQ(fxScene_Update(scene_, 0.0), FX_OK);
    EXPECT_EQ(hash(), before);
    EXPECT_EQ(statistics().steps, 1u);
}

TEST_F(SceneApi, aLongFrameIsShortenedAndTheRestIsCounted)
{
    ASSERT_EQ(fxScene_Update(scene_, 1.0), FX_OK);
    EXPECT_EQ(statistics().steps, 4u); // 1/15 s at 60 steps a second
    EXPECT_EQ(statistics().simulatedTick, FX_TICKS_PER_SECOND / 15);
    EXPECT_EQ(statistics().droppedTicks, FX_TICKS_PER_SECOND - FX_TICKS_PER_SECOND / 15);
    ASSERT_EQ(fxScene_Update(scene_, std::numeric_limits<double>::max()), FX_OK);
    EXPECT_EQ(statistics().steps, 8u);
}

TEST_F(SceneApi, aFrameShorterThanAStepWaitsForTheRest)
{
    ASSERT_EQ(fxScene_Update(scene_, 0.6 * kFrame), FX_OK);
    EXPECT_EQ(statistics().steps, 0u);
    ASSERT_EQ(fxScene_Update(scene_, 0.6 * kFrame), FX_OK);
    EXPECT_EQ(statistics().steps, 1u);
    EXPECT_NEAR(double(statistics().nowTick - statistics().simulatedTick), 0.2 * kFrame * FX_TICKS_PER_SECOND,
                1.0);
}

TEST_F(SceneApi, theFountainIsBornAtItsRateAndDiesAtItsAge)
{
    addFountain();
    for (int frame = 0; frame < 180; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    EXPECT_NEAR(double(statistics().born), 180.0, 1.0);
    EXPECT_NEAR(double(statistics().particles), 60.0, 1.0);
    EXPECT_EQ(statistics().dropped, 0u);
}

TEST_F(SceneApi, dormantInstancesCostNeitherParticlesNorWorkNorMemory)
{
    FxInstanceDef def = instanceDef();
    def.preset = loadText(context_, burstPreset(1000, 1.0));
    def.startTick = 10 * FX_TICKS_PER_SECOND;
    FxInstanceId id;
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    const uint64_t before = bytesInUse();
    for (int i = 0; i < 100; ++i)
        ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    EXPECT_LT(bytesInUse() - before,
              100u * 1024u); // one awake instance has 1000 particles of 100 bytes and more
    for (int frame = 0; frame < 60; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    const FxSceneStatistics now = statistics();
    EXPECT_EQ(now.instancesDormant, 101u);
    EXPECT_EQ(now.instancesActive, 0u);
    EXPECT_EQ(now.particles, 0u);
    EXPECT_EQ(now.particleSteps, 0u);
}

TEST_F(SceneApi, anInstanceWakesInTheStepThatContainsItsStart)
{
    FxInstanceDef def = instanceDef();
    def.preset = loadText(context_, burstPreset(10, 100.0));
    def.startTick = FX_TICKS_PER_SECOND / 60 * 3 + 5;
    FxInstanceId id;
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    FxInstanceState state{};
    for (int frame = 0; frame < 3; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    ASSERT_EQ(fxScene_GetInstanceState(scene_, id, &state, nullptr), FX_OK);
    EXPECT_EQ(state, FX_INSTANCE_DORMANT);
    ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    uint32_t particles = 0;
    ASSERT_EQ(fxScene_GetInstanceState(scene_, id, &state, &particles), FX_OK);
    EXPECT_EQ(state, FX_INSTANCE_ACTIVE);
    EXPECT_EQ(particles, 10u);
}

TEST_F(SceneApi, aFinishedInstanceIsNoLongerVisitedAndItsMemoryIsBack)
{
    FxInstanceDef def = instanceDef();
    def.preset = loadText(context_, burstPreset(1000, 0.1));
    FxInstanceId kept{}, gone{};
    uint64_t awake = 0;
    const auto runBoth = [&] {
        def.destroyWhenFinished = 0;
        ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &kept), FX_OK);
        def.destroyWhenFinished = 1;
        ++def.seed; // another one, so that they do not share a simulation
        ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &gone), FX_OK);
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
        EXPECT_EQ(statistics().particles, 2000u);
        awake = bytesInUse();
        for (int frame = 0; frame < 320; ++frame) // longer than releaseAfterTicks
            ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    };
    runBoth();
    ASSERT_EQ(fxScene_DestroyInstance(scene_, kept), FX_OK);
    const uint64_t baseline = bytesInUse(); // tables and snapshots keep their room
    runBoth();
    EXPECT_EQ(bytesInUse(), baseline);
    EXPECT_GT(awake, baseline + 2000 * 40); // positions, velocities, ages, ... of 2000 particles

    const FxSceneStatistics now = statistics();
    EXPECT_EQ(now.particles, 0u);
    EXPECT_EQ(now.instancesActive, 0u);
    EXPECT_EQ(now.instancesFinished, 1u);
    EXPECT_EQ(now.instances, 1u);
    EXPECT_EQ(fxScene_IsValid(scene_, kept), 1u);
    EXPECT_EQ(fxScene_IsValid(scene_, gone), 0u);
    ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    EXPECT_EQ(statistics().particleSteps, now.particleSteps);
    ASSERT_EQ(fxScene_DestroyInstance(scene_, kept), FX_OK);
    EXPECT_EQ(statistics().instances, 0u);
}

TEST_F(SceneApi, tenThousandInstancesComeAndGoWithoutATrace)
{
    const auto round = [this] {
        std::vector<FxInstanceId> ids;
        FxInstanceDef def = instanceDef();
        for (int i = 0; i < 10'000; ++i) {
            def.startTick = i % 3 == 0 ? 0 : FX_TICKS_PER_SECOND * (i % 7 + 1);
            FxInstanceId id{};
            ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
            ids.push_back(id);
        }
        EXPECT_EQ(statistics().instances, 10'000u);
        for (size_t i = 0; i < ids.size(); ++i)
            ASSERT_EQ(fxScene_DestroyInstance(scene_, ids[(i * 7919) % ids.size()]), FX_OK);
        EXPECT_EQ(statistics().instances, 0u);
    };
    round();
    const uint64_t baseline = bytesInUse(); // tables keep their room
    round();
    EXPECT_EQ(bytesInUse(), baseline);
    ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    EXPECT_EQ(statistics().particles, 0u);
}

TEST_F(SceneApi, destroyingASceneGivesItsMemoryBack)
{
    const uint64_t before = bytesInUse();
    const FxSceneDef def = fxDefaultSceneDef();
    FxScene* scene = nullptr;
    ASSERT_EQ(fxCreateScene(context_, &def, &scene), FX_OK);
    const FxInstanceDef instance = instanceDef();
    FxInstanceId id;
    ASSERT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK);
    ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    ASSERT_EQ(fxDestroyScene(scene), FX_OK);
    EXPECT_LE(bytesInUse(), before + 64); // the context's list of scenes may have grown
}
