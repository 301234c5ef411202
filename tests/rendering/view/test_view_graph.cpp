// Which passes a frame has: nothing that nothing calls for.
#include "tests/rendering/view/view_fixture.h"

#include <algorithm>
#include <string>
#include <vector>

using namespace fx;
using test::TestBlob;

namespace {

using Names = std::vector<std::string>;

class ViewGraphTest : public test::ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(96, 64);
        request_.camera = render::perspectiveView({{0, 0, 20}, {0, 0, 0}}, 1.0f, 1.5f, 0.1f);
        request_.targets = {color_->name(), depth_->name(), 0, false, 96, 64};
        request_.resetHistory = true; // lists of the last frame do not serve again
        setDepth(std::vector<float>(96 * 64, 1.0f));
    }

    Names passes(size_t blobCount, float heat = 0.0f)
    {
        std::vector<TestBlob> blobs(blobCount);
        for (size_t i = 0; i < blobCount; ++i) {
            blobs[i].center.x = float(i) - 1.0f;
            blobs[i].heat = heat;
        }
        const base::FrameSnapshot snapshot = snapshotOf(blobs);
        base::SnapshotPair pair;
        pair.newer = &snapshot;
        const base::Status status = view_->render(pair, request_);
        EXPECT_TRUE(status.ok()) << status.message();
        return {view_->executedPasses().begin(), view_->executedPasses().end()};
    }

    static bool has(const Names& names, const char* what)
    {
        return std::ranges::any_of(
            names, [&](const std::string& name) { return name.find(what) != std::string::npos; });
    }

    render::FrameRequest request_;
};

} // namespace

TEST_F(ViewGraphTest, anEmptySnapshotHasNoPass)
{
    EXPECT_TRUE(passes(0).empty());
}

TEST_F(ViewGraphTest, gasIsUploadedDrawnAndComposited)
{
    EXPECT_EQ(passes(3),
              (Names{"light list", "scene distance", "blob upload", "blob light", "media", "composite"}));
}

TEST_F(ViewGraphTest, shimmerComesOnlyWithHeatAndStrength)
{
    EXPECT_FALSE(has(passes(3), "shimmer"));
    EXPECT_EQ(passes(3, 500.0f),
              (Names{"light list", "scene distance", "blob upload", "blob light", "media", "composite",
                     "heat offset", "heat shimmer", "heat shimmer back", "present"}));
    view_->settings().shimmer.strength = 0.0f;
    EXPECT_FALSE(has(passes(3, 500.0f), "shimmer"));
}

TEST_F(ViewGraphTest, glareAndToneMappingComeBehindWhatBendsLight)
{
    view_->settings().dazzle.enabled = true;
    view_->settings().toneMap = true;
    EXPECT_EQ(passes(3, 500.0f),
              (Names{"light list", "scene distance", "blob upload", "blob light", "media", "composite",
                     "heat offset", "heat shimmer", "heat shimmer back", "dazzle sum", "dazzle budget",
                     "dazzle deal", "tone map", "present"}));
}

TEST_F(ViewGraphTest, layersAreResolvedOnlyWhenAskedFor)
{
    view_->settings().layerOutputs = true;
    EXPECT_TRUE(has(passes(3), "layer resolve"));
    EXPECT_NE(view_->layers().fire, 0u);
    view_->settings().layerOutputs = false;
    passes(3);
    EXPECT_EQ(view_->layers().fire, 0u);
}

TEST_F(ViewGraphTest, toneMappingAloneStillReachesTheHost)
{
    view_->settings().toneMap = true;
    EXPECT_EQ(passes(0), (Names{"tone map", "present"}));
}

TEST_F(ViewGraphTest, aFramebufferAloneIsDrawnOver)
{
    GLuint framebuffer = 0;
    device_->gl.CreateFramebuffers(1, &framebuffer);
    device_->gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, color_->name(), 0);
    request_.targets = {0, 0, framebuffer, true, 96, 64};
    view_->settings().toneMap = true;
    EXPECT_EQ(passes(3),
              (Names{"light list", "scene distance", "blob upload", "blob light", "media", "composite"}));
    device_->gl.DeleteFramebuffers(1, &framebuffer);
}

TEST_F(ViewGraphTest, manyBlobsAreInstancesOfOneDraw)
{
    passes(1);
    const uint32_t draws = view_->statistics().drawCalls;
    passes(5);
    EXPECT_EQ(view_->statistics().blobs, 5u);
    EXPECT_EQ(view_->statistics().drawCalls, draws);
}

TEST_F(ViewGraphTest, smallLayersAreDrawnToBothEndsOfTheDepthAndEnlarged)
{
    view_->settings().layerDivisor = 2;
    EXPECT_EQ(passes(3), (Names{"light list", "scene distance", "blob upload", "blob light", "layer distance",
                                "layer spread", "media", "media", "layer upsample", "composite"}));
    request_.targets.depth = 0;
    EXPECT_EQ(passes(3), (Names{"light list", "scene distance", "blob upload", "blob light", "layer distance",
                                "media", "layer upsample", "composite"}));
}
