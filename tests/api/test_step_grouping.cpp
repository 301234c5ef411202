// What a scene says about its state depends on time alone, not on the updates that led there; also when all
// particles are gone, and for what is sought.
#include "tests/api/api_fixture.h"
#include "tests/api/library_names.h"

#include <string>
#include <vector>

using namespace fx::test;

namespace {

constexpr int kMaxSeconds = 40;
constexpr uint64_t kMaxWork = 300'000; ///< particle steps; the gases of the library take more

/// How a second is cut into updates; [s], repeated, each whole repetition ends at a whole second.
struct Cut
{
    const char* what;
    std::vector<double> frames;
};

std::vector<double> evenly(int rate)
{
    return std::vector<double>(size_t(rate), 1.0 / rate);
}

const std::vector<Cut>& otherCuts()
{
    static const std::vector<Cut> cuts{
        {"10 Hz", evenly(10)},
        {"20 Hz", evenly(20)},
        {"30 Hz", evenly(30)},
        {"144 Hz", evenly(144)},
        {"240 Hz", evenly(240)},
        {"irregular", {0.001, 0.05, 0.013, 0.2, 0.0, 0.136, 0.0333, 0.0667, 0.1, 0.4}}};
    return cuts;
}

class StepGrouping : public ::testing::Test
{
protected:
    StepGrouping()
    {
        FxContextDef def = fxDefaultContextDef();
        def.workers = 1;
        EXPECT_EQ(fxCreateContext(&def, &context_), FX_OK);
    }
    ~StepGrouping() override { EXPECT_EQ(fxDestroyContext(context_), FX_OK); }

    FxScene* sceneOf(FxPresetId preset, FxInstanceId& outInstance)
    {
        FxSceneDef sceneDef = fxDefaultSceneDef();
        sceneDef.maxFrameTicks = FX_TICKS_PER_SECOND; // so that no time is lost
        FxScene* scene = nullptr;
        EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_OK);
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = preset;
        def.seed = 5;
        def.quality = FX_QUALITY_LOW;
        EXPECT_EQ(fxScene_CreateInstance(scene, &def, &outInstance), FX_OK);
        return scene;
    }
    static void playSecond(FxScene* scene, const std::vector<double>& frames)
    {
        for (const double dt : frames)
            EXPECT_EQ(fxScene_Update(scene, dt), FX_OK);
    }
    static void stopEmitting(FxScene* scene, FxInstanceId id)
    {
        FxInstanceParameters parameters = fxDefaultInstanceParameters();
        parameters.emitting = 0;
        EXPECT_EQ(fxScene_SetParameters(scene, id, &parameters), FX_OK);
    }
    static uint64_t hashOf(FxScene* scene)
    {
        uint64_t hash = 0;
        EXPECT_EQ(fxScene_GetStateHash(scene, &hash), FX_OK);
        return hash;
    }
    static FxSceneStatistics statisticsOf(FxScene* scene)
    {
        FxSceneStatistics now{};
        now.structSize = sizeof now;
        EXPECT_EQ(fxScene_GetStatistics(scene, &now), FX_OK);
        return now;
    }

    /// Hashes after each second: for one second the preset is played, then nothing new is born.
    std::vector<uint64_t> play(FxPresetId preset, const std::vector<double>& frames, int seconds)
    {
        FxInstanceId id{};
        FxScene* const scene = sceneOf(preset, id);
        std::vector<uint64_t> hashes;
        for (int s = 0; s < seconds; ++s) {
            playSecond(scene, frames);
            hashes.push_back(hashOf(scene));
            if (s == 0)
                stopEmitting(scene, id);
        }
        EXPECT_EQ(fxDestroyScene(scene), FX_OK);
        return hashes;
    }
    /// [s] until all particles are gone; 0: that takes too long, or too much
    int lengthOf(FxPresetId preset)
    {
        FxInstanceId id{};
        FxScene* const scene = sceneOf(preset, id);
        int length = 0;
        bool isTooMuch = false;
        for (int f = 1; f <= kMaxSeconds * 60 && length == 0 && !isTooMuch; ++f) {
            EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK);
            if (f == 60)
                stopEmitting(scene, id);
            const FxSceneStatistics now = statisticsOf(scene);
            isTooMuch = now.particleSteps > kMaxWork;
            length = f >= 60 && now.particles == 0 ? (f + 59) / 60 : 0;
        }
        EXPECT_EQ(fxDestroyScene(scene), FX_OK);
        return length;
    }

    FxContext* context_ = nullptr;
};

} // namespace

TEST_F(StepGrouping, hashesDoNotTellHowUpdatesWereCutWhileAPresetLivesAndAfterIt)
{
    int ended = 0;
    for (const std::string& name : fx::test::libraryNames()) {
        FxPresetId preset{};
        ASSERT_EQ(fxLoadPresetLibrary(context_, name.c_str(), &preset), FX_OK);
        const int length = lengthOf(preset);
        if (length == 0)
            continue; // what lives is compared by LibraryDeterminism
        ++ended;
        const std::vector<uint64_t> want = play(preset, evenly(60), length + 2);
        for (const Cut& cut : otherCuts())
            EXPECT_EQ(play(preset, cut.frames, length + 2), want) << name << ": " << cut.what;
    }
    EXPECT_GE(ended, fx::test::kHasGas ? 6 : 5);
}

TEST_F(StepGrouping, aSceneInWhichNothingEverWasHasTheHashOfItsTime)
{
    FxSceneDef def = fxDefaultSceneDef();
    def.maxFrameTicks = FX_TICKS_PER_SECOND;
    uint64_t hashes[2] = {}, later = 0;
    for (int k = 0; k < 2; ++k) {
        FxScene* scene = nullptr;
        ASSERT_EQ(fxCreateScene(context_, &def, &scene), FX_OK);
        playSecond(scene, evenly(k == 0 ? 60 : 10));
        hashes[k] = hashOf(scene);
        playSecond(scene, evenly(60));
        later = hashOf(scene);
        ASSERT_EQ(fxDestroyScene(scene), FX_OK);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_NE(later, hashes[0]);
}

TEST_F(StepGrouping, speedsAndSeeksThatLeadToTheSameTimeGiveTheSameHash)
{
    for (const char* name : {"library:muzzle-flash", "library:tracer", "library:sparks", "library:debris"}) {
        FxPresetId preset{};
        ASSERT_EQ(fxLoadPresetLibrary(context_, name, &preset), FX_OK);
        for (const double end : {1.0, 2.0}) { // of the effect's own time; all is over after some of them
            const auto played = [&](auto&& play) {
                FxInstanceId id{};
                FxScene* const scene = sceneOf(preset, id);
                play(scene, id);
                const uint64_t hash = hashOf(scene);
                EXPECT_EQ(fxDestroyScene(scene), FX_OK);
                return hash;
            };
            const int seconds = int(end);
            const uint64_t want = played([&](FxScene* scene, FxInstanceId) {
                for (int s = 0; s < seconds; ++s)
                    playSecond(scene, evenly(60));
            });
            EXPECT_EQ(want, played([&](FxScene* scene, FxInstanceId id) { // twice as fast, then not at all
                          EXPECT_EQ(fxScene_SetInstanceSpeed(scene, id, 2), FX_OK);
                          for (int f = 0; f < 30 * seconds; ++f)
                              EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK);
                          EXPECT_EQ(fxScene_SetInstanceSpeed(scene, id, 0), FX_OK);
                          for (int f = 0; f < 10 * seconds; ++f)
                              EXPECT_EQ(fxScene_Update(scene, 3 * kFrame), FX_OK);
                      }))
                << name << " at speed 2, then 0, until " << end;
            EXPECT_EQ(want,
                      played([&](FxScene* scene, FxInstanceId id) { // it stands still and is taken there
                          EXPECT_EQ(fxScene_SetInstanceSpeed(scene, id, 0), FX_OK);
                          for (int s = 0; s < seconds; ++s)
                              playSecond(scene, evenly(20));
                          EXPECT_EQ(fxScene_SeekInstance(scene, id, end), FX_OK);
                      }))
                << name << " sought while it stands still, to " << end;
            EXPECT_EQ(want, played([&](FxScene* scene, FxInstanceId id) { // there and back, and the last step
                          EXPECT_EQ(fxScene_SetInstanceSpeed(scene, id, 0), FX_OK);
                          for (int f = 0; f < 60 * seconds - 1; ++f)
                              EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK);
                          EXPECT_EQ(fxScene_SeekInstance(scene, id, end + 1.0), FX_OK);
                          EXPECT_EQ(fxScene_Update(scene, 0.0), FX_OK);
                          EXPECT_EQ(fxScene_SeekInstance(scene, id, end - kFrame), FX_OK);
                          EXPECT_EQ(fxScene_SetInstanceSpeed(scene, id, 1), FX_OK);
                          EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK);
                      }))
                << name << " sought backwards to a step before " << end;
        }
    }
}
