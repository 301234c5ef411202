// Instances in motion are drawn where the host's object is in the frame, between the steps.
#include "tests/api/view_fixture.h"

#include <cmath>
#include <cstdio>
#include <vector>

namespace {

using fx::test::kFrame;

constexpr double kSpeed = 6.0; ///< [m/s] a tenth of a meter in a step

/// Particles that live long and do not move in their space: flames, sprites and small groups that are merged.
constexpr const char* kStill = R"({"version": 1, "name": "still", "ground": false, "emitters": [
    {"name": "fire", "layer": "fire", "shape": "sphere", "size": 0.2, "emission": {"bursts": [{"time": 0, "count": 30}]},
     "lifetime": 100, "radius": 0.2, "temperature": 1700, "forces": {"gravity": 0}},
    {"name": "chips", "shape": "sphere", "size": 0.3, "emission": {"bursts": [{"time": 0, "count": 20}]},
     "lifetime": 100, "radius": 0.05, "forces": {"gravity": 0},
     "appearance": {"kind": "sprite", "blend": "additive", "luminance": 20000}}]})";

/// Flames, sprites and trails that stay where they are born.
constexpr const char* kLeft = R"({"version": 1, "name": "left behind", "ground": false, "emitters": [
    {"name": "fire", "layer": "fire", "space": "world", "emission": {"rate": 30}, "lifetime": 100, "radius": 0.2,
     "temperature": 1700, "forces": {"gravity": 0}},
    {"name": "chips", "space": "world", "position": [0, 0.6, 0], "emission": {"rate": 60}, "lifetime": 100,
     "radius": 0.05, "forces": {"gravity": 0},
     "appearance": {"kind": "sprite", "blend": "additive", "luminance": 20000}},
    {"name": "tails", "space": "world", "position": [0, -0.6, 0], "emission": {"rate": 30}, "lifetime": 100,
     "shape": "cone", "speed": 2, "forces": {"gravity": 0},
     "trail": {"lifetime": 1, "width": 0.1, "blend": "additive", "luminance": 20000},
     "appearance": {"kind": "none"}}]})";

class ViewMotion : public fx::test::ViewApiTest
{
protected:
    /// A scene with two instances, so that their sprites are merged where they may be.
    FxScene* makeScene(FxInstanceId& outFirst, double x, bool hasSecond = true)
    {
        FxScene* scene = nullptr;
        const FxSceneDef def = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &def, &scene), FX_OK);
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = preset_;
        instance.seed = 1;
        instance.position[0] = x;
        EXPECT_EQ(fxScene_CreateInstance(scene, &instance, &outFirst), FX_OK);
        if (!hasSecond) // what is not merged is sorted in other groups
            return scene;
        instance.seed = 2;
        instance.position[0] = 0.0;
        instance.position[1] = 1.0;
        FxInstanceId still{};
        EXPECT_EQ(fxScene_CreateInstance(scene, &instance, &still), FX_OK);
        return scene;
    }
    std::vector<float> drawn(FxScene* scene, uint32_t composition)
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.composition = composition;
        settings.dazzle = 0;
        FxView* view = nullptr;
        EXPECT_EQ(fxCreateView(context_, scene, &settings, &view), FX_OK);
        fillPicture();
        const FxFrameDef def = frame();
        EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        std::vector<float> all = picture();
        EXPECT_EQ(fxDestroyView(view), FX_OK);
        return all;
    }

    FxPresetId preset_ = fx::test::loadText(context_, kStill);
};

} // namespace

TEST_F(ViewMotion, drawsAnInstanceWhereItsObjectIs)
{
    for (const uint32_t composition : {FX_COMPOSITION_SLABS}) { // draws no streaks of what moves
        FxInstanceId moving{}, placed{}, carried{};
        FxScene* const inMotion = makeScene(moving, -1.0);
        FxScene* const byTransform = makeScene(carried, -1.0);
        double x = -1.0;
        int stepped = 0;
        for (int i = 0; i < 31; ++i) { // 144 frames a second: some take no step
            const double dt = 1.0 / 144.0;
            x += kSpeed * dt;
            FxMotion pose = fxDefaultMotion();
            pose.position[0] = x;
            pose.aheadSeconds = dt;
            ASSERT_EQ(fxScene_SetMotion(inMotion, moving, &pose), FX_OK) << fxGetLastErrorMessage();
            ASSERT_EQ(fxScene_SetTransform(byTransform, carried, pose.position, pose.rotation, 1.0f), FX_OK);
            ASSERT_EQ(fxScene_Update(inMotion, dt), FX_OK);
            ASSERT_EQ(fxScene_Update(byTransform, dt), FX_OK);
            if (i < 28)
                continue;
            FxScene* const still = makeScene(placed, x);
            for (int step = 0; step < 12; ++step)
                ASSERT_EQ(fxScene_Update(still, kFrame), FX_OK);
            const std::vector<float> wanted = drawn(still, composition);
            const float error = fx::test::largestShownDifference(drawn(inMotion, composition), wanted);
            const float lag = fx::test::largestShownDifference(drawn(byTransform, composition), wanted);
            std::printf("frame %d: in motion %.4f from the object, by transforms %.4f\n", i, double(error),
                        double(lag));
            EXPECT_LE(error, 4.0f / 255.0f);
            EXPECT_GT(lag, 0.1f);
            ASSERT_EQ(fxDestroyScene(still), FX_OK);
            ++stepped;
        }
        EXPECT_EQ(stepped, 3);
        ASSERT_EQ(fxDestroyScene(inMotion), FX_OK);
        ASSERT_EQ(fxDestroyScene(byTransform), FX_OK);
    }
}

TEST_F(ViewMotion, drawsAnInstanceAtThePoseOfAFrameWithoutAStep)
{
    for (const uint32_t composition : {FX_COMPOSITION_SORTED, FX_COMPOSITION_SLABS}) {
        FxInstanceId moving{}, placed{};
        FxScene* const scene = makeScene(moving, 0.0, false);
        FxScene* const still = makeScene(placed, 0.3, false);
        for (int i = 0; i < 6; ++i) {
            ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
            ASSERT_EQ(fxScene_Update(still, kFrame), FX_OK);
        }
        FxMotion pose = fxDefaultMotion();
        pose.position[0] = 0.3;
        ASSERT_EQ(fxScene_SetMotion(scene, moving, &pose), FX_OK) << fxGetLastErrorMessage();
        ASSERT_EQ(fxScene_Update(scene, 0.0), FX_OK);
        const float error =
            fx::test::largestShownDifference(drawn(scene, composition), drawn(still, composition));
        EXPECT_LE(error, 2.0f / 255.0f) << composition;
        ASSERT_EQ(fxDestroyScene(scene), FX_OK);
        ASSERT_EQ(fxDestroyScene(still), FX_OK);
    }
}

TEST_F(ViewMotion, aViewFollowsAMotionWhileNoStepIsTaken)
{
    FxInstanceId id{};
    FxScene* const scene = makeScene(id, 0.0);
    for (int i = 0; i < 6; ++i)
        ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    FxView* view = nullptr;
    const FxViewSettings settings = fxDefaultViewSettings();
    ASSERT_EQ(fxCreateView(context_, scene, &settings, &view), FX_OK);
    const FxFrameDef def = frame();
    std::vector<float> before;
    for (int i = 0; i < 3; ++i) { // the lists of a view are kept while nothing changes
        FxMotion pose = fxDefaultMotion();
        pose.position[0] = 0.2 * i;
        ASSERT_EQ(fxScene_SetMotion(scene, id, &pose), FX_OK) << fxGetLastErrorMessage();
        ASSERT_EQ(fxScene_Update(scene, 0.0), FX_OK);
        fillPicture();
        ASSERT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        const std::vector<float> now = picture();
        if (i > 0) {
            EXPECT_GT(fx::test::largestShownDifference(now, before), 0.1f);
        }
        before = now;
    }
    ASSERT_EQ(fxDestroyView(view), FX_OK);
    ASSERT_EQ(fxDestroyScene(scene), FX_OK);
}

TEST_F(ViewMotion, drawsWhatStaysInTheWorldWhereItIs)
{
    preset_ = fx::test::loadText(context_, kLeft);
    for (const uint32_t composition : {FX_COMPOSITION_SORTED, FX_COMPOSITION_SLABS}) {
        FxInstanceId moving{}, carried{};
        FxScene* const inMotion = makeScene(moving, -1.5);
        FxScene* const byTransform = makeScene(carried, -1.5);
        double x = -1.5;
        std::vector<float> first;
        for (int i = 0; i < 30; ++i) { // each frame has one step, in which both go the same way
            FxMotion pose = fxDefaultMotion();
            pose.aheadSeconds = kFrame;
            if (i > 0) // from the first step on
                x += kSpeed * kFrame;
            pose.position[0] = x;
            if (i > 0) {
                ASSERT_EQ(fxScene_SetMotion(inMotion, moving, &pose), FX_OK) << fxGetLastErrorMessage();
                ASSERT_EQ(fxScene_SetTransform(byTransform, carried, pose.position, pose.rotation, 1.0f),
                          FX_OK);
            }
            ASSERT_EQ(fxScene_Update(inMotion, kFrame), FX_OK);
            ASSERT_EQ(fxScene_Update(byTransform, kFrame), FX_OK);
            if (i == 10)
                first = drawn(inMotion, composition);
        }
        const std::vector<float> now = drawn(inMotion, composition);
        EXPECT_GT(fx::test::largestShownDifference(now, first), 0.1f) << composition;
        EXPECT_LE(fx::test::largestShownDifference(now, drawn(byTransform, composition)), 2.0f / 255.0f)
            << composition;
        ASSERT_EQ(fxDestroyScene(inMotion), FX_OK);
        ASSERT_EQ(fxDestroyScene(byTransform), FX_OK);
    }
}
