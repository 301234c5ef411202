// What is out of sight leaves nothing in a frame: no passes, no calls, no difference.
#include "tests/api/view_fixture.h"

#include <cmath>

using ViewSight = fx::test::ViewApiTest;

namespace {

/// The camera of a frame, or one that looks the other way.
FxFocus focusOf(const FxFrameDef& frame, bool away)
{
    FxFocus focus = fxDefaultFocus();
    for (int i = 0; i < 3; ++i)
        focus.origin[i] = frame.origin[i];
    for (int i = 0; i < 16; ++i)
        focus.projection[i] = frame.projection[i];
    focus.margin = 0; // the flames are three metres away
    if (away)
        focus.view[0] = focus.view[10] = -1.0f;
    return focus;
}

FxSceneStatistics statisticsOf(FxScene* scene)
{
    FxSceneStatistics statistics{};
    statistics.structSize = sizeof statistics;
    EXPECT_EQ(fxScene_GetStatistics(scene, &statistics), FX_OK);
    return statistics;
}

} // namespace

TEST_F(ViewSight, whatIsHiddenAddsNeitherPassesNorCallsAndComesBackWithoutCompiling)
{
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    warmUp();
    const FxFrameDef def = frame();
    update(30);
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_GT(statistics().textureBytes, 0u);
    const FxFocus away = focusOf(def, true);
    ASSERT_EQ(fxScene_SetFocus(scene_, &away, 1), FX_OK) << fxGetLastErrorMessage();
    update(3); // the last picture that had it is gone from both snapshots
    EXPECT_EQ(statisticsOf(scene_).instancesHidden, 1u);
    fillPicture();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(statistics().passes, 0u);
    EXPECT_EQ(statistics().glCalls, 0u);
    EXPECT_EQ(statistics().blobs, 0u);
    for (const float value : picture())
        ASSERT_TRUE(value == kBackground || value == 1.0f);

    for (int i = 0; i < 300; ++i)
        ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    EXPECT_EQ(statistics().textureBytes, 0u); // released, since they have not been used for long

    const FxFocus there = focusOf(def, false);
    ASSERT_EQ(fxScene_SetFocus(scene_, &there, 1), FX_OK);
    update(2);
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    EXPECT_GT(statistics().blobs, 0u);
    EXPECT_EQ(statistics().programsCompiled, 0u);
}

TEST_F(ViewSight, turningCullingOffChangesNeitherThePictureNorTheSimulation)
{
    const FxPresetId burst = fx::test::loadText(context_, fx::test::burstPreset(40, 3.0));
    std::vector<float> pictures[2];
    uint64_t hashes[2] = {};
    uint32_t hidden[2] = {};
    for (uint32_t k = 0; k < 2; ++k) {
        FxSceneDef sceneDef = fxDefaultSceneDef();
        sceneDef.disableCulling = k;
        FxScene* scene = nullptr;
        ASSERT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_OK);
        for (int i = 0; i < 8; ++i) {
            FxInstanceDef instance = fxDefaultInstanceDef();
            instance.preset = burst;
            instance.seed = uint64_t(i);
            instance.position[2] = i == 0 ? 0.0 : 300.0 * i; // one before the camera, the others far behind
            FxInstanceId id{};
            ASSERT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK);
        }
        const FxFrameDef def = frame();
        const FxFocus focus = focusOf(def, false);
        ASSERT_EQ(fxScene_SetFocus(scene, &focus, 1), FX_OK);
        for (int i = 0; i < 20; ++i)
            ASSERT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);
        hidden[k] = statisticsOf(scene).instancesHidden;
        FxView* view = nullptr;
        ASSERT_EQ(fxCreateView(context_, scene, nullptr, &view), FX_OK);
        fillPicture();
        ASSERT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        pictures[k] = picture();
        ASSERT_EQ(fxScene_GetSimulationHash(scene, &hashes[k]), FX_OK);
        ASSERT_EQ(fxDestroyView(view), FX_OK);
        ASSERT_EQ(fxDestroyScene(scene), FX_OK);
    }
    EXPECT_EQ(hidden[0], 7u);
    EXPECT_EQ(hidden[1], 0u);
    EXPECT_EQ(hashes[0], hashes[1]);
    float largest = 0, seen = 0;
    for (size_t i = 0; i < pictures[0].size(); ++i) {
        largest = std::max(largest, std::abs(pictures[0][i] - pictures[1][i]));
        seen = std::max(seen, std::abs(pictures[0][i] - kBackground) * (i % 4 == 3 ? 0.0f : 1.0f));
    }
    EXPECT_LE(largest, 1.0f / 255.0f);
    EXPECT_GT(seen, 0.02f); // there is something that could differ
}
