// Layers smaller than the picture, through the C API.
#include "tests/api/counting_new.h"
#include "tests/api/view_fixture.h"

#include <cstddef>

using fx::test::newCallsOfThisThread;
using ViewLayers = fx::test::ViewApiTest;

TEST_F(ViewLayers, areAsLargeAsAskedAndSaySo)
{
    update(60);
    FxViewSettings settings = fxDefaultViewSettings();
    const FxFrameDef def = frame();
    uint64_t larger = UINT64_MAX;
    for (const float scale : {1.0f, 0.5f, 0.25f}) {
        settings.layerScale = scale;
        ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
        ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(statistics().layerScale, scale);
        EXPECT_LT(statistics().estimatedFragments, larger);
        larger = statistics().estimatedFragments;
        EXPECT_GT(larger, 0u);
    }
}

TEST_F(ViewLayers, shrinkToKeepTheBudget)
{
    update(60);
    const FxFrameDef def = frame();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    FxViewSettings settings = fxDefaultViewSettings();
    settings.fragmentBudget = uint32_t(statistics().estimatedFragments - 1);
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    EXPECT_EQ(statistics().layerScale, 0.5f);
    EXPECT_LE(statistics().estimatedFragments, settings.fragmentBudget);
}

TEST_F(ViewLayers, ofAnApplicationThatDoesNotKnowThemAreFullSize)
{
    update(60);
    FxViewSettings settings = fxDefaultViewSettings();
    settings.structSize = offsetof(FxViewSettings, layerScale);
    settings.layerScale = 0.0f; // behind its end, whatever is there
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
    const FxFrameDef def = frame();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    EXPECT_EQ(statistics().layerScale, 1.0f);
}

TEST_F(ViewLayers, areDrawnByAWarmFrameWithoutCompilingOrAllocating)
{
    warmUp();
    FxViewSettings settings = fxDefaultViewSettings();
    settings.layerScale = 0.5f;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    const FxFrameDef def = frame();
    for (int i = 0; i < 110; ++i) {
        update(1);
        const uint64_t before = newCallsOfThisThread();
        ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        ASSERT_EQ(statistics().programsCompiled, 0u);
        if (i < 90)
            continue;
        EXPECT_EQ(newCallsOfThisThread() - before, 0u) << "frame " << i;
        EXPECT_EQ(statistics().allocations, 0u) << "frame " << i;
    }
}
