// The boxes of instances over the picture.
#include "tests/api/view_fixture.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using Names = std::vector<std::string>;

/// The fixture's flames, looked at by the frame's own camera.
class ViewOverlay : public fx::test::ViewApiTest
{
protected:
    void ask(uint32_t overlay)
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0;
        settings.shimmerStrength = 0;
        settings.activationOverlay = overlay;
        ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
    }
    Names passes() { return fx::test::passNamesOf(view_); }
    std::vector<float> drawn()
    {
        fillPicture();
        const FxFrameDef def = frame();
        EXPECT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        return picture();
    }
    /// Pixels in which one channel is above the other two by at least a half.
    static int pixelsOf(const std::vector<float>& picture, size_t channel)
    {
        int count = 0;
        for (size_t i = 0; i + 3 < picture.size(); i += 4) {
            const float most = std::max(picture[i + (channel + 1) % 3], picture[i + (channel + 2) % 3]);
            count += picture[i + channel] > most + 0.5f;
        }
        return count;
    }
    FxInstanceId instance()
    {
        FxInstanceId id{};
        uint32_t count = 0;
        EXPECT_EQ(fxScene_GetInstances(scene_, &id, 1, &count), FX_OK);
        return id;
    }
    void lookFromFrame()
    {
        const FxFrameDef def = frame();
        FxFocus focus = fxDefaultFocus();
        std::copy_n(def.origin, 3, focus.origin);
        std::copy_n(def.projection, 16, focus.projection);
        ASSERT_EQ(fxScene_SetFocus(scene_, &focus, 1), FX_OK) << fxGetLastErrorMessage();
    }
};

} // namespace

TEST_F(ViewOverlay, itsPassExistsOnlyWhenAskedForAndLeavesEverythingElseAsItWas)
{
    ask(0);
    update(10);
    const std::vector<float> before = drawn();
    const Names passes0 = passes();
    EXPECT_EQ(std::count(passes0.begin(), passes0.end(), "activation overlay"), 0);
    ask(1);
    update(1);
    const std::vector<float> with = drawn();
    Names passes1 = passes();
    ASSERT_FALSE(passes1.empty());
    EXPECT_EQ(passes1.back(), "activation overlay"); // over the finished picture
    passes1.pop_back();
    EXPECT_EQ(passes1, passes0);
    EXPECT_GT(pixelsOf(with, 1), 20);
    EXPECT_EQ(pixelsOf(before, 1), 0); // the control: flames are not green
    ask(0);
    update(1);
    const std::vector<float> after = drawn();
    EXPECT_EQ(passes(), passes0);
    EXPECT_EQ(pixelsOf(after, 1), 0);
}

TEST_F(ViewOverlay, theColorSaysTheStateAndLinesAreDrawnWhereNothingElseIs)
{
    ask(1);
    lookFromFrame();
    update(4);
    EXPECT_GT(pixelsOf(drawn(), 1), 20); // green: active
    FxActivationHints hints = fxDefaultActivationHints();
    hints.maxDistance = 0.5f; // too far
    ASSERT_EQ(fxScene_SetActivationHints(scene_, instance(), &hints), FX_OK);
    update(4);
    const std::vector<float> far = drawn();
    EXPECT_EQ(passes(), Names{"activation overlay"});
    EXPECT_GT(pixelsOf(far, 0), 20); // red: hidden
    EXPECT_EQ(pixelsOf(far, 1), 0);
    hints.occluded = 1;
    ASSERT_EQ(fxScene_SetActivationHints(scene_, instance(), &hints), FX_OK);
    update(2);
    const std::vector<float> occluded = drawn();
    EXPECT_EQ(pixelsOf(occluded, 0), 0);
    int orange = 0; // twice as much red as green, hardly any blue
    for (size_t i = 0; i + 3 < occluded.size(); i += 4)
        orange += occluded[i] > 0.8f && std::abs(occluded[i + 1] - 0.45f) < 0.05f && occluded[i + 2] < 0.2f;
    EXPECT_GT(orange, 20);
}

TEST_F(ViewOverlay, aFrameLikeTheOneBeforeAllocatesNothing)
{
    ask(1);
    update(150); // as many die as are born
    for (int i = 0; i < 8; ++i) {
        drawn();
        update(1);
    }
    drawn();
    EXPECT_EQ(statistics().allocations, 0u);
}
