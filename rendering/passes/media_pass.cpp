#include "rendering/passes/media_pass.h"

#include <algorithm>

namespace fx::render {

TextureDesc mediaTargetDesc(bool layers, size_t target, int width, int height)
{
    constexpr std::string_view kNames[MediaPass::LayerTargets] = {
        "fire light", "smoke light", "dust light", "coverage", "depth moment", "optical depth"};
    const bool scalar = layers && (target == MediaPass::DepthMoment || target == MediaPass::OpticalDepth);
    return {layers ? kNames[target] : "media", width, height, scalar ? Format::R32F : Format::RGBA32F};
}

namespace {

bool isFirstOfSource(std::span<const DrawBatch> batches, size_t index)
{
    return std::ranges::none_of(
        batches.first(index), [&](const DrawBatch& batch) { return batch.source == batches[index].source; });
}

} // namespace

MediaPass::Outputs MediaPass::addTo(FrameGraph& graph, const Inputs& in, const Outputs& under)
{
    Outputs out = under;
    if (in.batches.empty())
        return out; // nothing to draw: the graph does not even see this pass

    graph.addPass("media", [&](FrameGraph::Builder& builder) {
        const size_t targetCount = in.layers ? size_t(LayerTargets) : 1;
        const bool isFirst = !(in.layers ? under.layers[0] : under.media).valid();
        std::array<ResourceId, LayerTargets> targets;
        for (size_t i = 0; i < in.batches.size(); ++i)
            if (isFirstOfSource(in.batches, i))
                in.batches[i].source->read(builder);
        builder.read(in.distance);
        in.lights.read(builder);
        for (size_t i = 0; i < targetCount; ++i) {
            const ResourceId before = in.layers ? under.layers[i] : under.media;
            targets[i] = builder.write(
                isFirst ? builder.create(mediaTargetDesc(in.layers, i, in.width, in.height)) : before);
        }
        if (in.layers)
            out.layers = targets;
        else
            out.media = targets[0];

        return [in, targets, targetCount, isFirst](Backend& backend) {
            for (size_t i = 0; isFirst && i < targetCount; ++i)
                backend.clear(targets[i], {0.0f, 0.0f, 0.0f, 0.0f});
            const MediaTarget target{&in.view,  in.distance, {targets.data(), targetCount},
                                     in.layers, in.isSmall,  in.lights};
            for (const DrawBatch& batch : in.batches)
                batch.source->draw(backend, batch, target);
        };
    });
    return out;
}

} // namespace fx::render
