// FX_COMPOSITION_AUTOMATIC, and what a budget makes of compositions, as a host sees it.
#include "tests/api/counting_new.h"
#include "tests/api/view_fixture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace {

/// Large gray balls that stay where they are born.
/// @param size [m] radius of the ball of births
std::string ballsWith(const std::string& members, const char* size = "0.5")
{
    return R"({"version": 1, )" + members + R"("ground": false, "emitters": [
        {"layer": "smoke", "shape": "sphere", "size": )" +
           size +
           R"(, "emission": {"bursts": [{"time": 0, "count": 40}]},
         "lifetime": 2, "radius": 0.5, "crossSection": 0.3, "albedoOverLife": [0.5, 0.5, 0.5],
         "forces": {"gravity": 0}}]})";
}

class ViewComposition : public fx::test::ViewApiTest
{
protected:
    FxInstanceId add(const std::string& preset)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = fx::test::loadText(context_, preset);
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }

    void choose(uint32_t composition, float budget = 0.0f)
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0; // it adapts from frame to frame
        settings.composition = composition;
        settings.voxels = 32;
        settings.budgetMilliseconds = budget;
        settings.budgetClock = FX_BUDGET_CLOCK_CPU;
        ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
    }

    /// Draws media in voxels with FxViewSettings::multipleScattering `scattering`.
    std::vector<float> drawnScattering(uint32_t scattering)
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0;
        settings.composition = FX_COMPOSITION_VOLUME;
        settings.voxels = 48;
        settings.multipleScattering = scattering;
        EXPECT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
        return drawn();
    }

    std::vector<float> drawn()
    {
        fillPicture();
        const FxFrameDef def = frame();
        EXPECT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        return picture();
    }

    /// Sweeps of illumination networks in the last frame.
    size_t sweeps() const { return size_t(std::ranges::count(fx::test::passNamesOf(view_), "network rays")); }

    uint32_t drawnAs()
    {
        (void)drawn();
        return statistics().composition;
    }
};

/// Greatest of any channel of any pixel.
double difference(const std::vector<float>& a, const std::vector<float>& b)
{
    double most = 0.0;
    for (size_t i = 0; i < a.size(); ++i)
        most = std::max(most, std::abs(double(a[i]) - double(b[i])));
    return most;
}

} // namespace

TEST_F(ViewComposition, automaticIsWhatTheInstancesAskFor)
{
    update(1);
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_SORTED)) << "the default";
    choose(FX_COMPOSITION_AUTOMATIC);
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_SORTED)) << "nothing asks for anything";
    const FxInstanceId slabs = add(ballsWith(R"("composition": "slabs", )"));
    update(1);
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_SLABS));
    EXPECT_EQ(statistics().compositionSize, 16u);
    const FxInstanceId volume = add(ballsWith(R"("composition": "volume", )"));
    const FxInstanceId sorted = add(ballsWith(R"("composition": "sorted", )"));
    update(1);
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_VOLUME));
    EXPECT_EQ(statistics().compositionSize, 32u);
    choose(FX_COMPOSITION_SLABS);
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_SLABS)) << "the view has the last word";
    choose(FX_COMPOSITION_AUTOMATIC);
    ASSERT_EQ(fxScene_DestroyInstance(scene_, volume), FX_OK);
    update(1);
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_SLABS));
    ASSERT_EQ(fxScene_DestroyInstance(scene_, slabs), FX_OK);
    ASSERT_EQ(fxScene_DestroyInstance(scene_, sorted), FX_OK);
    update(1);
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_SORTED));
}

TEST_F(ViewComposition, automaticHasTheBitsOfWhatItStandsFor)
{
    add(ballsWith(R"("composition": "volume", )"));
    update(3);
    choose(FX_COMPOSITION_VOLUME);
    const std::vector<float> volume = drawn();
    choose(FX_COMPOSITION_AUTOMATIC);
    EXPECT_EQ(drawn(), volume);
    choose(FX_COMPOSITION_SORTED);
    EXPECT_NE(drawn(), volume);
}

TEST_F(ViewComposition, effectsThatHaveEndedAskForNothing)
{
    choose(FX_COMPOSITION_AUTOMATIC);
    add(ballsWith(R"("composition": "volume", "duration": 0.5, )"));
    update(2);
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_VOLUME));
    update(60);
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_SORTED));
}

TEST_F(ViewComposition, ofARestoredSceneIsThatOfItsInstances)
{
    choose(FX_COMPOSITION_AUTOMATIC);
    const auto saved = [&] {
        size_t size = 0;
        EXPECT_EQ(fxScene_SaveState(scene_, nullptr, 0, &size), FX_OK) << fxGetLastErrorMessage();
        std::vector<std::byte> bytes(size);
        EXPECT_EQ(fxScene_SaveState(scene_, bytes.data(), bytes.size(), &size), FX_OK);
        return bytes;
    };
    update(1);
    const std::vector<std::byte> before = saved();
    add(ballsWith(R"("composition": "volume", )"));
    update(1);
    const std::vector<std::byte> with = saved();
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_VOLUME));
    ASSERT_EQ(fxScene_RestoreState(scene_, before.data(), before.size()), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_SORTED));
    ASSERT_EQ(fxScene_RestoreState(scene_, with.data(), with.size()), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_VOLUME));
}

TEST_F(ViewComposition, aBudgetLowersVoxelsThenTheCompositionAndGivesItBack)
{
    const std::string calibration = R"({"version": 1, "techniques": [
        {"name": "media", "steps": [{"cost": 1, "error": 0, "setting": {"particles": 1}}]},
        {"name": "media", "composition": "volume", "steps": [
            {"cost": 0.0001, "error": 0.5, "setting": {"composition": "sorted"}},
            {"cost": 0.5, "error": 0.1, "setting": {"voxels": 16}},
            {"cost": 1, "error": 0, "setting": {}}]}]})";
    add(ballsWith(R"("composition": "volume", )"));
    update(3);
    choose(FX_COMPOSITION_AUTOMATIC);
    const std::vector<float> free = drawn();
    choose(FX_COMPOSITION_AUTOMATIC, 10'000.0f);
    ASSERT_EQ(fxView_SetQualityCalibration(view_, calibration.data(), calibration.size(), "mine.json"), FX_OK)
        << fxGetLastErrorMessage();
    for (int k = 0; k < 3; ++k)
        EXPECT_EQ(drawn(), free) << "a wide budget lowers nothing";
    choose(FX_COMPOSITION_AUTOMATIC, 1e-3f);
    EXPECT_EQ(drawnAs(), uint32_t(FX_COMPOSITION_SORTED)) << "the time of the frames before is known";
    FxQualityChoice choice{};
    choice.structSize = sizeof choice;
    ASSERT_EQ(fxView_GetQualityChoice(view_, 0, &choice), FX_OK) << fxGetLastErrorMessage();
    EXPECT_STREQ(choice.setting, "sorted");
    EXPECT_EQ(choice.steps, 3u);
    choose(FX_COMPOSITION_SORTED, 10'000.0f);
    (void)drawn();
    ASSERT_EQ(fxView_GetQualityChoice(view_, 0, &choice), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(choice.steps, 1u) << "views that ask for sorted have levels of their own";
    choose(FX_COMPOSITION_AUTOMATIC);
    EXPECT_EQ(drawn(), free) << "the settings were the host's all the time";
}

TEST_F(ViewComposition, automaticScatteringIsWhatTheInstancesAskForAndTheViewHasTheLastWord)
{
    constexpr uint32_t kSingle = 0, kClosedForm = 1, kNetwork = 2, kAutomatic = 3;
    constexpr double kAlike = 0.02; // the settings of the frames before leave up to 0.003
    add(ballsWith(R"("composition": "volume", )"));
    update(1);
    const std::vector<float> single = drawnScattering(kSingle), closed = drawnScattering(kClosedForm);
    ASSERT_NE(single, closed);
    EXPECT_EQ(drawnScattering(kAutomatic), closed) << "nothing asks for anything";
    const FxInstanceId once = add(ballsWith(R"("scattering": "single", )"));
    update(1);
    EXPECT_LT(difference(drawnScattering(kAutomatic), drawnScattering(kSingle)), kAlike);
    EXPECT_GT(difference(drawnScattering(kClosedForm), drawnScattering(kSingle)), 10 * kAlike);
    const FxInstanceId network =
        add(ballsWith(R"("composition": "volume", "scattering": "network", )", "2")); // large on the picture
    update(1);
    (void)drawnScattering(kAutomatic);
    EXPECT_GT(sweeps(), 0u);
    (void)drawnScattering(kClosedForm);
    EXPECT_EQ(sweeps(), 0u);
    (void)drawnScattering(kNetwork);
    EXPECT_GT(sweeps(), 0u);
    ASSERT_EQ(fxScene_DestroyInstance(scene_, network), FX_OK);
    update(1);
    EXPECT_LT(difference(drawnScattering(kAutomatic), drawnScattering(kSingle)), kAlike);
    ASSERT_EQ(fxScene_DestroyInstance(scene_, once), FX_OK);
    update(1);
    EXPECT_LT(difference(drawnScattering(kAutomatic), drawnScattering(kClosedForm)), kAlike);
}

TEST_F(ViewComposition, aNetworkAtRestHasNoPassAndAllocatesNothing)
{
    constexpr uint32_t kClosedForm = 1, kNetwork = 2;
    add(ballsWith(R"("composition": "volume", "scattering": "network", )"));
    update(1);
    for (const uint32_t composition : {FX_COMPOSITION_VOLUME, FX_COMPOSITION_SLABS}) {
        choose(composition);
        (void)drawnScattering(kClosedForm);
        (void)drawn();
        const std::vector<std::string> plain = fx::test::passNamesOf(view_); // at rest
        (void)drawnScattering(kNetwork);
        EXPECT_GE(sweeps(), 8u) << "from darkness";
        for (int i = 0; i < 20 && sweeps() > 0; ++i)
            (void)drawn();
        for (int i = 0; i < 3; ++i) {
            (void)drawn();
            EXPECT_EQ(fx::test::passNamesOf(view_), plain) << "no pass of the network is left";
            EXPECT_EQ(statistics().allocations, 0u);
        }
    }
}

TEST_F(ViewComposition, listsOfGrowingMediaDoubleAndDoNotGrowInEachFrame)
{
    constexpr int kFirst = 10, kFrames = 40; // in the first second particles are born and none dies
    choose(FX_COMPOSITION_VOLUME);
    const FxFrameDef def = frame();
    int growing = 0;
    for (int i = 0; i < kFirst + kFrames; ++i) {
        update(1);
        const uint64_t before = fx::test::newCallsOfThisThread();
        ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        const bool allocates = fx::test::newCallsOfThisThread() != before || statistics().allocations > 0;
        growing += i >= kFirst && allocates ? 1 : 0;
    }
    EXPECT_LT(growing, kFrames / 2);
}

TEST_F(ViewComposition, movingMediaAllocateNothingOnceTheyAreWarm)
{
    // as many balls are born as die; they rise, so that bricks and tiles begin and end
    add(R"({"version": 1, "ground": false, "emitters": [
        {"layer": "smoke", "shape": "sphere", "size": 0.5, "emission": {"rate": 60}, "lifetime": 1, "radius": 0.4,
         "crossSection": 0.3, "albedoOverLife": [0.5, 0.5, 0.5], "forces": {"gravity": -2}}]})");
    constexpr int kWarm = 12, kFrames = 12;
    update(70);
    struct Case
    {
        const char* name;
        uint32_t composition;
        uint32_t scattering;
        bool layers;
    };
    constexpr uint32_t kClosedForm = 1, kNetwork = 2;
    for (const Case& one : {Case{"slabs", FX_COMPOSITION_SLABS, kClosedForm, false},
                            Case{"volume", FX_COMPOSITION_VOLUME, kClosedForm, false},
                            Case{"volume, network", FX_COMPOSITION_VOLUME, kNetwork, false},
                            Case{"volume, layers", FX_COMPOSITION_VOLUME, kClosedForm, true}})
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.composition = one.composition;
        settings.multipleScattering = one.scattering;
        settings.layerOutputs = one.layers ? 1 : 0;
        settings.voxels = 32;
        ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
        const FxFrameDef def = frame();
        for (int i = 0; i < kWarm + kFrames; ++i) {
            update(1);
            const uint64_t before = fx::test::newCallsOfThisThread();
            ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
            if (i < kWarm)
                continue;
            EXPECT_EQ(fx::test::newCallsOfThisThread() - before, 0u) << one.name << ", frame " << i;
            EXPECT_EQ(statistics().allocations, 0u) << one.name << ", frame " << i;
        }
        EXPECT_EQ(statistics().composition, one.composition);
        EXPECT_EQ(sweeps(), one.scattering == kNetwork ? 2u : 0u);
    }
}
