#include "rendering/passes/layer_sums_pass.h"

namespace fx::render {

namespace {

using Layers = LayerOverPass::Layers;

constexpr size_t kResolved = MediaPass::DepthMoment + 1; ///< layers before the optical depth

/// @param count how many of the layers the program reads, from the first on
void drawSums(Backend& backend, const ProgramDesc& program, const Layers& layers, size_t count,
              std::span<const ResourceId> targets, Blend blend)
{
    std::array<TextureBinding, MediaPass::LayerTargets> textures;
    for (size_t i = 0; i < count; ++i)
        textures[i] = {uint32_t(i), layers[i]};
    DrawCall call;
    call.program = &program;
    call.targets = targets;
    call.textures = {textures.data(), count};
    call.blend = blend;
    backend.draw(call);
}

} // namespace

Layers LayerOverPass::addTo(FrameGraph& graph, const Layers& over, const Layers& under)
{
    Layers out;
    graph.addPass("layer over", [&](FrameGraph::Builder& builder) {
        for (size_t i = 0; i < out.size(); ++i) {
            builder.read(over[i]);
            out[i] = builder.write(under[i]);
        }
        return [over, out](Backend& backend) {
            drawSums(backend, kLayerOverProgram, over, over.size(), out, Blend::Premultiplied);
        };
    });
    return out;
}

LayerResolvePass::Outputs LayerResolvePass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("layer resolve", [&](FrameGraph::Builder& builder) {
        for (size_t i = 0; i < kResolved; ++i)
            builder.read(in.layers[i]);
        const auto target = [&](std::string_view name, Format format) {
            return builder.write(builder.create({name, in.width, in.height, format}));
        };
        out.fire = target("fire", Format::RGBA32F);
        out.smoke = target("smoke", Format::RGBA32F);
        out.dust = target("dust", Format::RGBA32F);
        out.media = target("media", Format::RGBA32F);
        out.depth = target("media distance", Format::R32F);

        return [in, out](Backend& backend) {
            const ResourceId targets[] = {out.fire, out.smoke, out.dust, out.media, out.depth};
            drawSums(backend, kLayerResolveProgram, in.layers, kResolved, targets, Blend::None);
        };
    });
    return out;
}

} // namespace fx::render
