// Reports of why an instance is seen or not, compared with pictures.
#include "tests/api/view_fixture.h"

#include <algorithm>
#include <vector>

namespace {

class Visibility : public fx::test::ViewApiTest
{
protected:
    Visibility()
    {
        const FxSceneDef def = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &def, &empty_), FX_OK);
        EXPECT_EQ(fxView_SetScene(view_, empty_), FX_OK);
        preset_ = fx::test::loadText(context_, fx::test::burstPreset(40, 1.0));
    }

    FxInstanceId add(double x, double y, double z, int64_t start = 0)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = preset_;
        def.startTick = start;
        def.position[0] = x;
        def.position[1] = y;
        def.position[2] = z;
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(empty_, &def, &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }
    void step(int updates = 3)
    {
        for (int i = 0; i < updates; ++i)
            ASSERT_EQ(fxScene_Update(empty_, fx::test::kFrame), FX_OK) << fxGetLastErrorMessage();
    }
    FxVisibility report(FxInstanceId id, bool hasCamera = true)
    {
        FxVisibility visibility{};
        visibility.structSize = sizeof visibility;
        const FxFrameDef camera = frame();
        EXPECT_EQ(fxScene_ExplainVisibility(empty_, id, hasCamera ? &camera : nullptr, &visibility), FX_OK)
            << fxGetLastErrorMessage();
        return visibility;
    }
    uint32_t causeOf(FxInstanceId id) { return report(id).cause; }
    bool isSeen()
    {
        fillPicture();
        const std::vector<float> before = picture();
        const FxFrameDef def = frame();
        EXPECT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        return picture() != before;
    }

    FxScene* empty_ = nullptr;
    FxPresetId preset_{};
};

} // namespace

TEST_F(Visibility, ofAnInstanceInViewIsThatOfThePicture)
{
    const FxInstanceId id = add(0, 0, 0);
    step();
    EXPECT_EQ(causeOf(id), uint32_t(FX_VISIBILITY_IN_VIEW));
    EXPECT_TRUE(isSeen());
    const FxVisibility visibility = report(id);
    EXPECT_EQ(visibility.particles, 40u);
    EXPECT_EQ(visibility.state, uint32_t(FX_INSTANCE_ACTIVE));
    EXPECT_GT(visibility.radius, 0.0f);
    EXPECT_NEAR(visibility.distance, 3.0f, visibility.radius);
    // 90 degrees: half the picture is as high as the distance
    EXPECT_NEAR(visibility.pixels, visibility.radius / visibility.distance * 0.5f * kSize, 1e-4f);
}

TEST_F(Visibility, ofAnInstanceOutOfViewNamesTheSide)
{
    const FxInstanceId behind = add(0, 0, 30), beside = add(40, 0, 0), above = add(0, 60, 0);
    step();
    EXPECT_EQ(causeOf(behind), uint32_t(FX_VISIBILITY_BEHIND));
    EXPECT_EQ(causeOf(beside), uint32_t(FX_VISIBILITY_BESIDE));
    EXPECT_EQ(causeOf(above), uint32_t(FX_VISIBILITY_BESIDE));
    EXPECT_FALSE(isSeen());
    EXPECT_EQ(report(behind, false).cause, uint32_t(FX_VISIBILITY_IN_VIEW)); // no camera is asked
    EXPECT_EQ(report(behind, false).distance, 0.0f);
}

TEST_F(Visibility, ofAFarInstanceNamesItsSize)
{
    const FxInstanceId far = add(0, 0, -9e6);
    step();
    EXPECT_EQ(causeOf(far), uint32_t(FX_VISIBILITY_TOO_SMALL));
    EXPECT_LT(report(far).pixels, 0.04f);
}

TEST_F(Visibility, followsTheLifeOfAnInstance)
{
    const FxInstanceId id = add(0, 0, 0, FX_TICKS_PER_SECOND / 10);
    EXPECT_EQ(causeOf(id), uint32_t(FX_VISIBILITY_NOT_STARTED));
    step(2);
    EXPECT_EQ(causeOf(id), uint32_t(FX_VISIBILITY_NOT_STARTED));
    EXPECT_FALSE(isSeen());
    step(8);
    EXPECT_EQ(causeOf(id), uint32_t(FX_VISIBILITY_IN_VIEW));
    EXPECT_TRUE(isSeen());
    step(90);
    EXPECT_EQ(causeOf(id), uint32_t(FX_VISIBILITY_ENDED));
    EXPECT_FALSE(isSeen());
}

TEST_F(Visibility, ofAnInstanceThatCullingHidesStatesTheReason)
{
    preset_ = fx::test::loadText(context_, fx::test::fountainPreset());
    const FxInstanceId id = add(0, 0, 0);
    step();
    EXPECT_EQ(causeOf(id), uint32_t(FX_VISIBILITY_IN_VIEW));
    FxActivationHints hints = fxDefaultActivationHints();
    hints.occluded = 1;
    ASSERT_EQ(fxScene_SetActivationHints(empty_, id, &hints), FX_OK);
    FxFocus focus = fxDefaultFocus();
    std::copy_n(frame().projection, 16, focus.projection);
    focus.origin[2] = 3.0;
    ASSERT_EQ(fxScene_SetFocus(empty_, &focus, 1), FX_OK) << fxGetLastErrorMessage();
    step(40);
    EXPECT_EQ(causeOf(id), uint32_t(FX_VISIBILITY_HIDDEN));
    EXPECT_EQ(report(id).reason, uint32_t(FX_REASON_OCCLUDED));
    EXPECT_FALSE(isSeen());
}

TEST_F(Visibility, ofAnEmitterWithoutIntensityIsThatThereAreNoParticles)
{
    preset_ = fx::test::loadText(context_, fx::test::fountainPreset());
    const FxInstanceId id = add(0, 0, 0);
    FxInstanceParameters off = fxDefaultInstanceParameters();
    off.intensity = 0.0f;
    ASSERT_EQ(fxScene_SetParameters(empty_, id, &off), FX_OK);
    step(3);
    EXPECT_EQ(causeOf(id), uint32_t(FX_VISIBILITY_NO_PARTICLES));
    EXPECT_FALSE(isSeen());
}

TEST_F(Visibility, refusesWrongArgumentsAndChangesNothing)
{
    const FxInstanceId id = add(0, 0, 0);
    step();
    FxVisibility visibility{};
    visibility.cause = 77;
    FxFrameDef camera = frame();
    EXPECT_EQ(fxScene_ExplainVisibility(empty_, id, &camera, &visibility), FX_ERROR_VERSION);
    visibility.structSize = sizeof visibility;
    EXPECT_EQ(fxScene_ExplainVisibility(nullptr, id, &camera, &visibility), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_ExplainVisibility(empty_, id, &camera, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_ExplainVisibility(empty_, FxInstanceId{}, &camera, &visibility), FX_ERROR_STALE_ID);
    camera.height = 0;
    EXPECT_EQ(fxScene_ExplainVisibility(empty_, id, &camera, &visibility), FX_ERROR_INVALID_ARGUMENT);
    camera = frame();
    camera.projection[0] = 0.0f;
    EXPECT_EQ(fxScene_ExplainVisibility(empty_, id, &camera, &visibility), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(visibility.cause, 77u);
}

TEST_F(Visibility, hasADifferentTextForEachCause)
{
    for (uint32_t a = 0; a <= FX_VISIBILITY_MASKED; ++a)
        for (uint32_t b = 0; b < a; ++b)
            EXPECT_STRNE(fxGetVisibilityText(a), fxGetVisibilityText(b));
    EXPECT_STREQ(fxGetVisibilityText(FX_VISIBILITY_MASKED + 1), "unknown cause");
}
