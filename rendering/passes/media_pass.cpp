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

MediaTargets::MediaTargets(FrameGraph::Builder& builder, const MediaPass::Inputs& in,
                           const MediaPass::Outputs& under)
    : layers_(in.layers), isFirst_(!(in.layers ? under.layers[0] : under.media).valid())
{
    for (size_t i = 0; i < all().size(); ++i) {
        const ResourceId before = layers_ ? under.layers[i] : under.media;
        targets_[i] = builder.write(
            isFirst_ ? builder.create(mediaTargetDesc(layers_, i, in.width, in.height)) : before);
    }
}

void MediaTargets::clear(Backend& backend) const
{
    if (isFirst_)
        for (const ResourceId target : all())
            backend.clear(target, {0.0f, 0.0f, 0.0f, 0.0f});
}

MediaPass::Outputs MediaTargets::outputs() const
{
    MediaPass::Outputs out;
    if (layers_)
        out.layers = targets_;
    else
        out.media = targets_[0];
    return out;
}

MediaPass::Outputs MediaPass::addTo(FrameGraph& graph, const Inputs& in, const Outputs& under)
{
    Outputs out = under;
    if (in.batches.empty())
        return out; // nothing to draw: the graph does not even see this pass

    graph.addPass("media", [&](FrameGraph::Builder& builder) {
        for (size_t i = 0; i < in.batches.size(); ++i)
            if (isFirstOfSource(in.batches, i))
                in.batches[i].source->read(builder);
        builder.read(in.distance);
        in.lights.read(builder);
        const MediaTargets targets(builder, in, under);
        out = targets.outputs();
        return [in, targets](Backend& backend) {
            targets.clear(backend);
            const MediaTarget target{&in.view, in.distance, targets.all(), in.layers, in.isSmall, in.lights};
            for (const DrawBatch& batch : in.batches)
                batch.source->draw(backend, batch, target);
        };
    });
    return out;
}

} // namespace fx::render
