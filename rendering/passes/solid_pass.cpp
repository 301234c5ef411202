#include "rendering/passes/solid_pass.h"

#include <algorithm>

namespace fx::render {

SolidPass::Outputs SolidPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    out.distance = in.distance;
    if (in.sources.empty())
        return out;

    graph.addPass("solid particles", [&](FrameGraph::Builder& builder) {
        constexpr size_t kMax = size_t(MediaPass::LayerTargets) + 1;
        const size_t mediaTargets = in.layers ? size_t(MediaPass::LayerTargets) : 1;
        std::array<ResourceId, kMax> targets;
        builder.read(in.distance);
        in.lights.read(builder);
        for (const MediaSource* source : in.sources)
            source->read(builder);
        for (size_t i = 0; i < mediaTargets; ++i)
            targets[i] = builder.write(builder.create(mediaTargetDesc(in.layers, i, in.width, in.height)));
        out.distance = targets[mediaTargets] =
            builder.write(builder.create({"solid distance", in.width, in.height, Format::R32F}));
        const ResourceId depth =
            builder.write(builder.create({"particle depth", in.width, in.height, Format::Depth32F}));
        if (in.layers)
            std::copy_n(targets.begin(), mediaTargets, out.under.layers.begin());
        else
            out.under.media = targets[0];

        return [in, targets, mediaTargets, depth](Backend& backend) {
            for (size_t i = 0; i < mediaTargets; ++i)
                backend.clear(targets[i], {0.0f, 0.0f, 0.0f, 0.0f});
            backend.copyTexture(in.distance, targets[mediaTargets]);
            backend.clear(depth, {0.0f, 0.0f, 0.0f, 0.0f});
            const MediaTarget target{&in.view,  in.distance, {targets.data(), mediaTargets + 1},
                                     in.layers, false,       in.lights};
            for (const MediaSource* source : in.sources)
                source->drawSolids(backend, target, depth);
        };
    });
    return out;
}

} // namespace fx::render
