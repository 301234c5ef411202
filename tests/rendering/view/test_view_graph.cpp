// Which passes a frame has, seen through the recording backend: nothing that nothing calls for.
#include "rendering/frame_graph/recording_backend.h"
#include "rendering/stage/stage_camera.h"
#include "rendering/view/view_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace fx::render;

namespace {

constexpr HotArea kAreas[] = {{16, 16, 48, 32}};

class ViewGraphTest : public testing::Test
{
protected:
    ViewGraphTest()
    {
        request_.camera = perspectiveView({{0, 0, 20}, {0, 0, 0}}, 1.0f, 1.5f, 0.1f);
        request_.targets = {1, 2, 0, false, 96, 64};
        settings_.dazzle.enabled = false;
    }

    std::vector<std::string> passes(size_t blobCount, bool heat = false)
    {
        blobs_.assign(blobCount, BlobInstance{});
        graph_.begin();
        runs_.clear();
        if (blobCount > 0)
            runs_.push_back({MediaRun::kBlobs, 0, uint32_t(blobCount)});
        outputs_ = buildViewGraph(graph_, {&request_,
                                           &settings_,
                                           blobs_,
                                           {},
                                           runs_,
                                           heat ? std::span(kAreas) : std::span<const HotArea>(),
                                           false,
                                           7});
        graph_.compile();
        EXPECT_TRUE(graph_.status().ok()) << graph_.status().message();
        return {graph_.executedPasses().begin(), graph_.executedPasses().end()};
    }

    FrameRequest request_;
    ViewSettings settings_;
    std::vector<BlobInstance> blobs_;
    std::vector<MediaRun> runs_;
    FrameGraph graph_{std::pmr::get_default_resource()};
    ViewGraphOutputs outputs_;
};

using Names = std::vector<std::string>;

} // namespace

TEST_F(ViewGraphTest, anEmptySnapshotHasNoPass)
{
    EXPECT_TRUE(passes(0).empty());
    EXPECT_FALSE(outputs_.anyPass);
}

TEST_F(ViewGraphTest, gasIsUploadedDrawnAndComposited)
{
    EXPECT_EQ(passes(3), (Names{"scene distance", "blob upload", "media", "composite"}));
}

TEST_F(ViewGraphTest, shimmerComesOnlyWithHeatAndStrength)
{
    const auto has = [](const Names& names, const char* what) {
        for (const auto& name : names)
            if (name.find(what) != std::string::npos)
                return true;
        return false;
    };
    EXPECT_FALSE(has(passes(3, false), "shimmer"));
    EXPECT_TRUE(has(passes(3, true), "shimmer"));
    settings_.shimmer.strength = 0.0f;
    EXPECT_FALSE(has(passes(3, true), "shimmer"));
}

TEST_F(ViewGraphTest, layersAreResolvedOnlyWhenAskedFor)
{
    settings_.layerOutputs = true;
    const auto names = passes(3);
    EXPECT_NE(std::find(names.begin(), names.end(), "layer resolve"), names.end());
    EXPECT_TRUE(outputs_.fire.valid());
    settings_.layerOutputs = false;
    passes(3);
    EXPECT_FALSE(outputs_.fire.valid());
}

TEST_F(ViewGraphTest, toneMappingAloneStillReachesTheHost)
{
    settings_.toneMap = true;
    EXPECT_EQ(passes(0), (Names{"tone map", "present"}));
}

TEST_F(ViewGraphTest, aFramebufferAloneIsDrawnOver)
{
    request_.targets = {0, 0, 5, true, 96, 64};
    settings_.toneMap = true;
    EXPECT_EQ(passes(3), (Names{"scene distance", "blob upload", "media", "composite"}));
}

TEST_F(ViewGraphTest, everyBlobIsAnInstanceOfOneDraw)
{
    passes(5);
    RecordingBackend backend(graph_);
    graph_.execute(backend);
    EXPECT_EQ(graph_.executedPasses().size(), 4u);
}

TEST_F(ViewGraphTest, smallLayersAreDrawnToBothEndsOfTheDepthAndEnlarged)
{
    blobs_.assign(3, BlobInstance{});
    runs_.push_back({MediaRun::kBlobs, 0, 3});
    const auto passesOf = [&](uint32_t depth) {
        request_.targets.depth = depth;
        graph_.begin();
        outputs_ = buildViewGraph(graph_, {&request_, &settings_, blobs_, {}, runs_, {}, false, 7, 2});
        graph_.compile();
        EXPECT_TRUE(graph_.status().ok()) << graph_.status().message();
        return Names(graph_.executedPasses().begin(), graph_.executedPasses().end());
    };
    EXPECT_EQ(passesOf(2), (Names{"scene distance", "blob upload", "layer distance", "layer spread", "media",
                                  "media", "layer upsample", "composite"}));
    EXPECT_EQ(outputs_.layerWidth, 48);
    EXPECT_EQ(passesOf(0), (Names{"scene distance", "blob upload", "layer distance", "media",
                                  "layer upsample", "composite"}));
}
