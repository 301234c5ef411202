// Emitters that ask for the GPU, through the C API.
#include "fxsdk/fx_snapshot.h"
#include "tests/api/view_fixture.h"

#include <string>
#include <vector>

namespace fx::test {

namespace {

/// Sprites that any renderer can compute; their host never notices who does.
constexpr const char* kSparks = R"({"version": 1, "name": "sparks", "emitters": [
    {"name": "sparks", "compute": "gpu", "shape": "sphere", "size": [0.3, 0, 0], "speed": {"min": 1, "max": 2},
     "emission": {"rate": 400}, "lifetime": {"min": 0.3, "max": 0.8}, "radius": 0.03, "maxParticles": 500,
     "appearance": {"kind": "sprite", "order": "depth", "luminance": 5000}}]})";

/// Sprites whose motion has no closed form.
constexpr const char* kFlakes = R"({"version": 1, "name": "flakes", "emitters": [
    {"name": "flakes", "compute": "gpu", "shape": "sphere", "size": [1, 0, 0], "position": [0, 2, 0],
     "emission": {"rate": 400}, "lifetime": {"min": 0.3, "max": 0.8}, "radius": 0.03, "maxParticles": 500,
     "forces": {"drag": 2, "curlStrength": 1, "gust": [1, 0, 1]},
     "collisions": [{"shape": "plane", "position": [0, 1.5, 0], "response": "stick"}],
     "appearance": {"kind": "sprite", "order": "depth", "luminance": 5000}}]})";

} // namespace

class ViewGpu : public ViewApiTest
{
protected:
    ViewGpu()
    {
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = loadText(context_, kSparks);
        EXPECT_EQ(fxScene_CreateInstance(scene_, &instance, &sparks_), FX_OK) << fxGetLastErrorMessage();
    }
    /// Frames as a game has them.
    void play(int frames)
    {
        for (int i = 0; i < frames; ++i) {
            ASSERT_EQ(fxScene_Update(scene_, 1.0 / 60.0), FX_OK) << fxGetLastErrorMessage();
            const FxFrameDef def = frame();
            ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        }
    }
    /// Rows of the kind "particle" in the newer step of a snapshot, and how many live.
    void countRows(uint32_t& outRows, uint32_t& outLiving)
    {
        FxSnapshotId id{};
        ASSERT_EQ(fxScene_AcquireSnapshot(scene_, &id), FX_OK) << fxGetLastErrorMessage();
        FxSnapshotInfo info{};
        info.structSize = sizeof info;
        ASSERT_EQ(fxScene_GetSnapshotInfo(scene_, id, &info), FX_OK);
        outRows = outLiving = 0;
        for (uint32_t g = 0; g < info.groupsNewer; ++g) {
            FxSnapshotGroup group{};
            group.structSize = sizeof group;
            ASSERT_EQ(fxScene_GetSnapshotGroup(scene_, id, FX_SNAPSHOT_NEWER, g, &group), FX_OK);
            EXPECT_STRNE(group.kind, "gpuParticle");
            if (std::string(group.kind) != "particle")
                continue;
            FxSnapshotColumn radius{};
            radius.structSize = sizeof radius;
            ASSERT_EQ(fxScene_FindSnapshotColumn(scene_, id, FX_SNAPSHOT_NEWER, g, "radius", &radius), FX_OK);
            outRows += group.count;
            for (uint32_t i = 0; i < radius.count; ++i)
                outLiving += radius.values[i] > 0.0f ? 1 : 0;
        }
        EXPECT_EQ(fxScene_ReleaseSnapshot(scene_, id), FX_OK);
    }

    FxInstanceId sparks_{};
};

TEST_F(ViewGpu, computesWhatAsksForItOnceAViewIsThere)
{
    warmUp(); // knows the preset now
    play(20);
    EXPECT_EQ(statistics().gpuParticles, 500u);
    EXPECT_EQ(statistics().programsCompiled, 0u);
    play(60);
    EXPECT_EQ(statistics().gpuParticles, 500u);
    EXPECT_EQ(statistics().allocations, 0u);
}

TEST_F(ViewGpu, handsOutRowsAllTheSameAndLeavesThemToTheCpuForAWhile)
{
    play(60);
    ASSERT_EQ(statistics().gpuParticles, 500u);
    uint32_t rows = 0, living = 0;
    countRows(rows, living);
    EXPECT_GT(rows, 0u);
    EXPECT_GT(living, 150u); // 400 births a second that live for 0.55 s
    EXPECT_LT(living, 300u);
    play(3);
    EXPECT_EQ(statistics().gpuParticles, 0u);
    play(400);
    EXPECT_EQ(statistics().gpuParticles, 500u);
}

TEST_F(ViewGpu, isLeftAloneWithoutAView)
{
    update(60); // without drawing
    uint32_t rows = 0, living = 0;
    countRows(rows, living);
    EXPECT_GT(living, 150u);
}

TEST_F(ViewGpu, doesNotChangeTheHashesOfTheScene)
{
    FxScene* other = nullptr;
    const FxSceneDef def = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context_, &def, &other), FX_OK);
    for (const char* text : {kSparks}) {
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = loadText(context_, text);
        FxInstanceId id{};
        ASSERT_EQ(fxScene_CreateInstance(other, &instance, &id), FX_OK);
    }
    ASSERT_EQ(fxDestroyView(view_), FX_OK);
    FxScene* drawn = nullptr;
    ASSERT_EQ(fxCreateScene(context_, &def, &drawn), FX_OK);
    FxInstanceDef instance = fxDefaultInstanceDef();
    instance.preset = loadText(context_, kSparks);
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(drawn, &instance, &id), FX_OK);
    ASSERT_EQ(fxCreateView(context_, drawn, nullptr, &view_), FX_OK);
    for (int i = 0; i < 90; ++i) {
        ASSERT_EQ(fxScene_Update(drawn, 1.0 / 60.0), FX_OK);
        ASSERT_EQ(fxScene_Update(other, 1.0 / 60.0), FX_OK);
        const FxFrameDef frameDef = frame();
        ASSERT_EQ(fxView_Render(view_, &frameDef), FX_OK);
    }
    EXPECT_EQ(statistics().gpuParticles, 500u);
    uint64_t a = 0, b = 0;
    ASSERT_EQ(fxScene_GetStateHash(drawn, &a), FX_OK) << fxGetLastErrorMessage();
    ASSERT_EQ(fxScene_GetStateHash(other, &b), FX_OK);
    EXPECT_EQ(a, b);
}

/// All that later steps depend on, wherever rows are: with a view that computes them and without any.
TEST_F(ViewGpu, leavesTheSimulationOfSteppedEmittersAsItIs)
{
    const FxSceneDef def = fxDefaultSceneDef();
    FxScene* scenes[2] = {};
    for (FxScene*& scene : scenes) {
        ASSERT_EQ(fxCreateScene(context_, &def, &scene), FX_OK);
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = loadText(context_, kFlakes);
        FxInstanceId id{};
        ASSERT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK) << fxGetLastErrorMessage();
    }
    ASSERT_EQ(fxDestroyView(view_), FX_OK);
    ASSERT_EQ(fxCreateView(context_, scenes[0], nullptr, &view_), FX_OK);
    for (int i = 0; i < 90; ++i) {
        for (FxScene* scene : scenes)
            ASSERT_EQ(fxScene_Update(scene, 1.0 / 60.0), FX_OK);
        const FxFrameDef frameDef = frame();
        ASSERT_EQ(fxView_Render(view_, &frameDef), FX_OK);
    }
    EXPECT_EQ(statistics().gpuParticles, 500u);
    uint64_t a = 0, b = 0;
    ASSERT_EQ(fxScene_GetSimulationHash(scenes[0], &a), FX_OK) << fxGetLastErrorMessage();
    ASSERT_EQ(fxScene_GetSimulationHash(scenes[1], &b), FX_OK);
    EXPECT_EQ(a, b);
}

} // namespace fx::test
