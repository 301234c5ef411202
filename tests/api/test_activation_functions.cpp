#include "tests/api/api_fixture.h"

#include <limits>

using ActivationApi = fx::test::ApiTest;

namespace {

FxFocus camera()
{
    FxFocus focus = fxDefaultFocus();
    focus.projection[0] = focus.projection[5] = 1.0f;
    focus.projection[10] = -1.0f;
    focus.projection[11] = -1.0f;
    focus.projection[14] = -0.2f;
    return focus;
}

} // namespace

TEST_F(ActivationApi, aCameraThatLooksAwayHidesTheFountainAndStatisticsSaySo)
{
    const FxInstanceId id = addFountain();
    FxFocus focus = camera();
    focus.origin[2] = -100; // the fountain in the origin is behind it
    ASSERT_EQ(fxScene_SetFocus(scene_, &focus, 1), FX_OK) << fxGetLastErrorMessage();
    play(3);
    FxInstanceActivity activity{};
    activity.structSize = sizeof activity;
    ASSERT_EQ(fxScene_GetInstanceActivity(scene_, id, &activity), FX_OK);
    EXPECT_EQ(activity.state, uint32_t(FX_INSTANCE_HIDDEN));
    EXPECT_EQ(activity.reason, uint32_t(FX_REASON_OUTSIDE));
    EXPECT_EQ(activity.policy, uint32_t(FX_CATCH_UP_ANALYTIC));
    EXPECT_EQ(activity.lagTicks, FX_TICKS_PER_SECOND / 20);
    FxFrameStats stats{};
    stats.structSize = sizeof stats;
    ASSERT_EQ(fxScene_GetFrameStats(scene_, &stats), FX_OK);
    EXPECT_EQ(stats.hidden, 1u);
    EXPECT_EQ(stats.instances,
              stats.dormant + stats.active + stats.finished + stats.waking + stats.resting + stats.hidden);
    EXPECT_EQ(stats.particleSteps, 0u);
    EXPECT_EQ(statistics().instancesHidden, 1u);
    ASSERT_EQ(fxScene_SetFocus(scene_, nullptr, 0), FX_OK);
    play(1);
    ASSERT_EQ(fxScene_GetFrameStats(scene_, &stats), FX_OK);
    EXPECT_EQ(stats.active, 1u);
    EXPECT_EQ(stats.cameBack, 1u);
    EXPECT_EQ(stats.catchUpTicks, FX_TICKS_PER_SECOND / 20);
}

TEST_F(ActivationApi, gasesAreAuthoritativeUnlessTheirPresetSaysOtherwise)
{
    FX_NEEDS_GAS();
    FxInstanceDef def = instanceDef();
    FxInstanceActivity activity{};
    activity.structSize = sizeof activity;
    FxInstanceId id{};
    def.preset = fx::test::loadText(context_, R"({"version": 1, "gas": [{"particles": 40}]})");
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    ASSERT_EQ(fxScene_GetInstanceActivity(scene_, id, &activity), FX_OK);
    EXPECT_EQ(activity.policy, uint32_t(FX_CATCH_UP_AUTHORITATIVE));
    def.preset = fx::test::loadText(
        context_, R"({"version": 1, "gas": [{"particles": 40}], "offscreen": "skip", "bound": 30})");
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    ASSERT_EQ(fxScene_GetInstanceActivity(scene_, id, &activity), FX_OK);
    EXPECT_EQ(activity.policy, uint32_t(FX_CATCH_UP_SKIP));
    EXPECT_EQ(activity.reach, 30.0f);
}

TEST_F(ActivationApi, aGasThatIsReplayedComesBackAsIfItHadNeverBeenAway)
{
    FX_NEEDS_GAS();
    const FxPresetId blast = fx::test::loadText(
        context_, R"({"version": 1, "gas": [{"particles": 40}], "offscreen": "replay", "bound": 50})");
    uint64_t hashes[2] = {};
    for (uint32_t k = 0; k < 2; ++k) {
        FxSceneDef sceneDef = fxDefaultSceneDef();
        sceneDef.disableCulling = k;
        FxScene* scene = nullptr;
        ASSERT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_OK);
        FxInstanceDef def = instanceDef();
        def.preset = blast;
        FxInstanceId id{};
        ASSERT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK);
        FxFocus focus = camera();
        for (int turn = 0; turn < 6; ++turn) {
            focus.origin[2] = turn % 2 ? 20 : -500;
            ASSERT_EQ(fxScene_SetFocus(scene, &focus, 1), FX_OK);
            for (int frame = 0; frame < 12; ++frame)
                ASSERT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);
        }
        ASSERT_EQ(fxScene_GetSimulationHash(scene, &hashes[k]), FX_OK);
        ASSERT_EQ(fxDestroyScene(scene), FX_OK);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST_F(ActivationApi, wrongCamerasAreRefusedAndTheOldOnesStay)
{
    addFountain();
    const FxFocus good = camera();
    ASSERT_EQ(fxScene_SetFocus(scene_, &good, 1), FX_OK);
    FxFocus bad[2] = {good, good};
    bad[1].projection[0] = 0;
    EXPECT_EQ(fxScene_SetFocus(scene_, bad, 2), FX_ERROR_INVALID_ARGUMENT);
    bad[1] = good;
    bad[1].view[0] = 2;
    EXPECT_EQ(fxScene_SetFocus(scene_, bad, 2), FX_ERROR_INVALID_ARGUMENT);
    bad[1] = good;
    bad[1].origin[1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(fxScene_SetFocus(scene_, bad, 2), FX_ERROR_INVALID_ARGUMENT);
    bad[1] = good;
    bad[1].structSize = 3;
    EXPECT_EQ(fxScene_SetFocus(scene_, bad, 2), FX_ERROR_VERSION);
    EXPECT_EQ(fxScene_SetFocus(scene_, nullptr, 1), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetFocus(scene_, bad, 65), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetFocus(nullptr, nullptr, 0), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(ActivationApi, wrongHintsBudgetsAndIdsAreRefused)
{
    const FxInstanceId id = addFountain();
    FxActivationHints hints = fxDefaultActivationHints();
    EXPECT_EQ(fxScene_SetActivationHints(scene_, id, &hints), FX_OK);
    EXPECT_EQ(fxScene_SetActivationHints(scene_, id, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetActivationHints(scene_, FxInstanceId{}, &hints), FX_ERROR_STALE_ID);
    hints.priority = -1;
    EXPECT_EQ(fxScene_SetActivationHints(scene_, id, &hints), FX_ERROR_INVALID_ARGUMENT);
    FxBudget budget = fxDefaultBudget();
    EXPECT_EQ(fxScene_SetBudget(scene_, &budget), FX_OK);
    budget.milliseconds = std::numeric_limits<float>::infinity();
    EXPECT_EQ(fxScene_SetBudget(scene_, &budget), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetBudget(scene_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    FxInstanceActivity activity{};
    EXPECT_EQ(fxScene_GetInstanceActivity(scene_, id, &activity), FX_ERROR_VERSION);
    EXPECT_EQ(fxScene_GetInstanceActivity(scene_, id, nullptr), FX_ERROR_INVALID_ARGUMENT);
    FxFrameStats stats{};
    EXPECT_EQ(fxScene_GetFrameStats(scene_, &stats), FX_ERROR_VERSION);
    EXPECT_EQ(fxScene_GetFrameStats(nullptr, &stats), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(ActivationApi, sceneDefinitionsOutOfRangeAreRefused)
{
    FxScene* scene = nullptr;
    FxSceneDef def = fxDefaultSceneDef();
    def.catchUpSteps = 0;
    EXPECT_EQ(fxCreateScene(context_, &def, &scene), FX_ERROR_INVALID_ARGUMENT);
    def = fxDefaultSceneDef();
    def.maxCatchUpTicks = -1;
    EXPECT_EQ(fxCreateScene(context_, &def, &scene), FX_ERROR_INVALID_ARGUMENT);
    def = fxDefaultSceneDef();
    def.lockStep = 2;
    EXPECT_EQ(fxCreateScene(context_, &def, &scene), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(scene, nullptr);
}
