// Every request for memory of a frame is refused in turn: it is drawn, or the picture is the host's.
#include "tests/api/memory_sweep.h"
#include "tests/api/view_fixture.h"

using fx::test::kFrame;
using fx::test::refuseEach;

namespace {

class ViewMemorySweep : public fx::test::ViewApiTest
{
protected:
    ViewMemorySweep()
    {
        FxContextDef def = fxDefaultContextDef();
        def.allocator = scarce_.hooks();
        def.workers = 1;
        def.gl = {gl_->loader().user, gl_->loader().getProcAddress};
        EXPECT_EQ(fxCreateContext(&def, &mine_), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(fxContext_WarmUp(mine_), FX_OK) << fxGetLastErrorMessage();
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(mine_, &sceneDef, &shown_), FX_OK);
        for (const char* preset : {"magic-trail", "debris", "campfire"}) {
            FxInstanceDef instance = fxDefaultInstanceDef();
            EXPECT_EQ(fxLoadPresetLibrary(mine_, preset, &instance.preset), FX_OK);
            FxInstanceId id{};
            EXPECT_EQ(fxScene_CreateInstance(shown_, &instance, &id), FX_OK);
        }
        for (int i = 0; i < 20; ++i)
            EXPECT_EQ(fxScene_Update(shown_, kFrame), FX_OK);
    }
    ~ViewMemorySweep() override
    {
        EXPECT_EQ(fxDestroyContext(mine_), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(scarce_.blocks(), 0);
    }

    /// A view that has not drawn yet draws.
    FxResult draw()
    {
        FxView* view = nullptr;
        FxResult result = fxCreateView(mine_, shown_, nullptr, &view);
        const FxFrameDef def = frame();
        if (result == FX_OK)
            result = fxView_Render(view, &def);
        EXPECT_EQ(fxDestroyView(view), FX_OK);
        return result;
    }

    fx::test::ScarceMemory scarce_;
    FxContext* mine_ = nullptr;
    FxScene* shown_ = nullptr;
};

} // namespace

TEST_F(ViewMemorySweep, aFrameIsDrawnOrThePictureIsTheHosts)
{
    const std::vector<float> host = picture();
    ASSERT_EQ(draw(), FX_OK) << fxGetLastErrorMessage();
    const std::vector<float> wanted = picture();
    ASSERT_NE(wanted, host);
    uint64_t before = 0;
    ASSERT_EQ(fxScene_GetStateHash(shown_, &before), FX_OK);
    const auto drawOnHost = [&] {
        fillPicture();
        return draw();
    };
    const auto isAsBefore = [&] {
        uint64_t hash = 0;
        EXPECT_EQ(fxScene_GetStateHash(shown_, &hash), FX_OK);
        return hash == before && picture() == host;
    };
    EXPECT_GT(refuseEach(scarce_, drawOnHost, isAsBefore), 0u);
    EXPECT_EQ(picture(), wanted);
}
