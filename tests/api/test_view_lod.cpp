// Level of detail and kept lists, through the C API.
#include "tests/api/counting_new.h"
#include "tests/api/view_fixture.h"

#include <cmath>
#include <cstddef>

using fx::test::newCallsOfThisThread;

namespace {

class ViewLod : public fx::test::ViewApiTest
{
protected:
    void setBias(float bias)
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0;
        settings.exposureEv100 = 18.0f;
        settings.lodBias = bias;
        ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
    }

    FxViewStatistics draw(double distance)
    {
        FxFrameDef def = frame();
        def.origin[2] = distance;
        fillPicture();
        EXPECT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        return statistics();
    }

    /// Light that the effects have added to the picture.
    double light()
    {
        double sum = 0.0;
        const std::vector<float> rgba = picture();
        for (size_t i = 0; i < rgba.size(); i += 4)
            sum += double(rgba[i]) - double(kBackground);
        return sum;
    }

    uint64_t hashOf(FxScene* scene)
    {
        uint64_t hash = 0;
        EXPECT_EQ(fxScene_GetSimulationHash(scene, &hash), FX_OK);
        return hash;
    }
};

} // namespace

TEST_F(ViewLod, aFarEffectIsDrawnWithFewerParticlesAndTheSameLight)
{
    update(90);
    // at 40 m thick flames are smaller than a pixel, where a fifth of them hides less than all do
    for (const auto& [distance, bound] : {std::pair(40.0, 0.25), std::pair(15.0, 0.15)}) {
        double allLight = 0.0;
        double fewLight = 0.0;
        for (int moment = 0; moment < 12; ++moment, update(9)) {
            setBias(0.0f);
            const FxViewStatistics all = draw(distance);
            allLight += light();
            EXPECT_EQ(all.blobsThinned, 0u);
            EXPECT_EQ(all.lodGroups[0], 2u);
            setBias(4.0f);
            const FxViewStatistics few = draw(distance);
            fewLight += light();
            EXPECT_LT(few.blobs, all.blobs / 2);
            EXPECT_EQ(few.blobs + few.blobsThinned, all.blobs);
            EXPECT_EQ(few.lodGroups[0] + few.lodGroups[1] + few.lodGroups[2] + few.lodGroups[3], 2u);
            EXPECT_LT(few.lodGroups[0], 2u);
        }
        EXPECT_NEAR(fewLight / allLight, 1.0, bound) << distance;
    }
    EXPECT_EQ(draw(3.0).lodGroups[0], 2u) << "from near nothing is left out";
}

TEST_F(ViewLod, spritesMeshesAndPiecesOfRibbonsAreCountedExactly)
{
    const auto add = [this](const std::string& more) {
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = fx::test::loadText(context_, R"({"version": 1, "ground": false, "emitters": [{
            "maxParticles": 400, "shape": "sphere", "size": 0.5, "radius": 0.05, "speed": 0.2, "lifetime": 60,
            "forces": {"gravity": 0}, "emission": {"rate": 0, "bursts": [{"time": 0, "count": 300}]}, )" +
                                                           more + "}]}");
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &instance, &id), FX_OK) << fxGetLastErrorMessage();
    };
    setBias(0.0f);
    EXPECT_EQ(draw(3.0).sprites, 0u);
    add(R"("appearance": {"kind": "sprite"})");
    update(3);
    EXPECT_EQ(draw(3.0).sprites, 300u) << "not the empty rows";
    EXPECT_EQ(draw(3.0).sprites, 300u) << "of a frame like the last, too";
    EXPECT_EQ(draw(-3.0).sprites, 0u) << "behind the camera";
    add(R"("appearance": {"kind": "sprite", "order": "depth", "blend": "alpha"})");
    add(R"("appearance": {"kind": "mesh", "mesh": "library:debris-chunk.obj"})");
    update(3);
    EXPECT_EQ(draw(3.0).sprites, 600u);
    EXPECT_EQ(draw(3.0).meshes, 300u);
    EXPECT_EQ(draw(3.0).ribbonPieces, 0u);
    setBias(64.0f);
    const FxViewStatistics few = draw(30.0);
    EXPECT_LT(few.sprites, 600u);
    EXPECT_EQ(few.sprites + few.meshes + few.particlesThinned, 900u);
    setBias(0.0f);
    add(R"("appearance": {"kind": "sprite"}, "trail": {"lifetime": 10})");
    update(30);
    const uint64_t pieces = draw(3.0).ribbonPieces;
    EXPECT_GE(pieces, 300u);
    EXPECT_EQ(pieces % 300, 0u) << "each particle has the same trail";
}

TEST_F(ViewLod, isNothingToTheSimulation)
{
    uint64_t before = hashOf(scene_);
    setBias(64.0f);
    for (int i = 0; i < 30; ++i) {
        (void)draw(20.0 + i);
        EXPECT_EQ(hashOf(scene_), before) << "drawing changed the state";
        update(1);
        EXPECT_NE(hashOf(scene_), before) << "a step does";
        before = hashOf(scene_);
    }
}

TEST_F(ViewLod, aFrameLikeTheLastUploadsAndSortsNothingAndAStepDoes)
{
    update(60);
    setBias(0.0f);
    EXPECT_EQ(draw(3.0).keptLists, 0u);
    const FxViewStatistics again = draw(3.0);
    EXPECT_EQ(again.keptLists, 1u);
    EXPECT_EQ(again.uploadedBytes, 0u);
    EXPECT_EQ(again.sortedParticles, 0u);
    EXPECT_GT(again.blobs, 0u) << "and it is drawn";
    update(1);
    const FxViewStatistics next = draw(3.0);
    EXPECT_EQ(next.keptLists, 0u);
    EXPECT_GT(next.uploadedBytes, 0u);
    EXPECT_GT(next.sortedParticles, 0u);
}

TEST_F(ViewLod, passesOfAFrameShareMemory)
{
    update(60);
    const FxFrameDef def = frame(); // shimmer and glare, one after the other
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    EXPECT_GT(statistics().sharedBytes, 0u);
    EXPECT_LT(statistics().sharedBytes, statistics().unsharedBytes);
    EXPECT_LE(statistics().sharedBytes, statistics().textureBytes);
}

TEST_F(ViewLod, ofAnApplicationThatDoesNotKnowItIsOff)
{
    update(60);
    FxViewSettings settings = fxDefaultViewSettings();
    settings.structSize = offsetof(FxViewSettings, lodBias);
    settings.lodBias = 64.0f; // behind its end, whatever is there
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(draw(60.0).blobsThinned, 0u);
}

TEST_F(ViewLod, aFlightAllocatesNothingOnceItIsWarm)
{
    setBias(4.0f);
    for (int i = 0; i < 110; ++i) {
        update(1);
        const uint64_t before = newCallsOfThisThread();
        const FxViewStatistics now = draw(5.0 + 30.0 * std::abs(std::sin(0.3 * i)));
        if (i < 90)
            continue;
        EXPECT_EQ(newCallsOfThisThread() - before, 0u) << "frame " << i;
        EXPECT_EQ(now.allocations, 0u) << "frame " << i;
    }
}
