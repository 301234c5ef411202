/// Which programs the frames of fx render compile.

#include "fxsdk/cli/render/frame_renderer.h"
#include "fxsdk/cli/scene/default_stage.h"

#include <gtest/gtest.h>

#include <utility>

namespace fx::cli {
namespace {

/// Numbers of programs that the first two frames compile.
std::pair<uint32_t, uint32_t> compiledBy(bool warmsUp)
{
    const auto scene = sceneOfPreset("library:sparks");
    EXPECT_TRUE(scene.ok()) << scene.status().message();
    FrameRendererOptions options;
    options.width = options.height = 16;
    options.settings = scene->view;
    options.warmsUp = warmsUp;
    const auto renderer = FrameRenderer::create(*scene, options);
    EXPECT_TRUE(renderer.ok()) << renderer.status().message();
    uint32_t compiled[2] = {};
    for (const int i : {0, 1}) {
        EXPECT_TRUE((*renderer)->render(base::toTicks(0.2 + 0.1 * i)).ok());
        compiled[i] = (*renderer)->counters().view.programsCompiled;
    }
    return {compiled[0], compiled[1]};
}

TEST(FrameRenderer, compilesInAFrameWhatItNeedsOnlyOrAllBefore)
{
    const auto [first, second] = compiledBy(false);
    EXPECT_GT(first, 0u);
    EXPECT_LT(first, 30u) << "a fraction of all";
    EXPECT_EQ(second, 0u);
    EXPECT_EQ(compiledBy(true).first, 0u);
}

} // namespace
} // namespace fx::cli
