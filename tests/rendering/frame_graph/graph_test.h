/// @file graph_test.h
/// Functions that declare simple passes for tests of the frame graph.
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/frame_graph/recording_backend.h"
#include "tests/rendering/frame_graph/add_pass.h"

#include <gtest/gtest.h>

#include <memory_resource>
#include <string_view>
#include <vector>

namespace fx::render {

class GraphTest : public ::testing::Test
{
protected:
    GraphTest() { graph.begin(); }

    static TextureDesc texture(std::string_view name, int size = 64, Format format = Format::RGBA16F)
    {
        return {name, size, size, format};
    }

    /// Adds a pass that writes a new texture.
    ResourceId source(std::string_view name, int size = 64, Format format = Format::RGBA16F)
    {
        ResourceId out;
        addPass(
            graph, name,
            [&](FrameGraph::Builder& builder) {
                out = builder.write(builder.create(texture(name, size, format)));
            },
            [](Backend&) {});
        return out;
    }

    /// Adds a pass that reads `inputs` and writes a new texture.
    ResourceId filter(std::string_view name, std::vector<ResourceId> inputs, int size = 64,
                      Format format = Format::RGBA16F)
    {
        ResourceId out;
        addPass(
            graph, name,
            [&](FrameGraph::Builder& builder) {
                for (const ResourceId input : inputs)
                    builder.read(input);
                out = builder.write(builder.create(texture(name, size, format)));
            },
            [](Backend&) {});
        return out;
    }

    /// Adds a pass that changes `target` in place.
    ResourceId blend(std::string_view name, ResourceId target)
    {
        ResourceId out;
        addPass(
            graph, name, [&](FrameGraph::Builder& builder) { out = builder.write(target); }, [](Backend&) {});
        return out;
    }

    std::vector<std::string_view> executed() const
    {
        return {graph.executedPasses().begin(), graph.executedPasses().end()};
    }

    using Names = std::vector<std::string_view>;
    FrameGraph graph{std::pmr::get_default_resource()};
};

} // namespace fx::render
