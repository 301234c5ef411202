/// @file add_pass.h
/// Declares a pass in tests.
#pragma once

#include "rendering/frame_graph/frame_graph.h"

#include <string_view>
#include <utility>

namespace fx::render {

/// Adds a pass with separate functions for setup and execution.
template <class Setup, class Execute>
void addPass(FrameGraph& graph, std::string_view name, Setup&& setup, Execute execute)
{
    graph.addPass(name, [&](FrameGraph::Builder& builder) {
        std::forward<Setup>(setup)(builder);
        return execute;
    });
}

} // namespace fx::render
