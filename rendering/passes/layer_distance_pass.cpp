#include "rendering/passes/layer_distance_pass.h"

#include <limits>

namespace fx::render {

namespace {

using Ends = LayerDistancePass::Outputs;

Ends endTargets(FrameGraph::Builder& builder, const LayerDistancePass::Inputs& in)
{
    const auto target = [&](std::string_view name) {
        return builder.write(builder.create(TextureDesc{name, in.width, in.height, Format::R32F}));
    };
    return {target("far distance"), target("near distance")};
}

void drawEnds(Backend& backend, const ProgramDesc& program, std::span<const TextureBinding> textures,
              const Ends& out, const float (&numbers)[4])
{
    const ResourceId targets[] = {out.far, out.near};
    DrawCall call;
    call.program = &program;
    call.targets = targets;
    call.textures = textures;
    call.uniforms = asUniforms(numbers);
    backend.draw(call);
}

/// Nothing occludes.
Ends addEndless(FrameGraph& graph, const LayerDistancePass::Inputs& in)
{
    Ends out;
    graph.addPass("layer distance", [&](FrameGraph::Builder& builder) {
        out.far =
            builder.write(builder.create(TextureDesc{"far distance", in.width, in.height, Format::R32F}));
        return [target = out.far](Backend& backend) {
            constexpr float kFar = std::numeric_limits<float>::infinity();
            backend.clear(target, {kFar, kFar, kFar, kFar});
        };
    });
    return out;
}

} // namespace

Ends LayerDistancePass::addTo(FrameGraph& graph, const Inputs& in)
{
    if (!in.hasDepth)
        return addEndless(graph, in);
    Ends blocks, out;
    graph.addPass("layer distance", [&](FrameGraph::Builder& builder) {
        builder.read(in.distance);
        blocks = endTargets(builder, in);
        return [in, blocks](Backend& backend) {
            const TextureBinding textures[] = {{0, in.distance}};
            drawEnds(backend, kLayerDistanceProgram, textures, blocks,
                     {float(in.divisor), kFlatBlock, 0.0f, 0.0f});
        };
    });
    graph.addPass("layer spread", [&](FrameGraph::Builder& builder) {
        builder.read(blocks.far);
        builder.read(blocks.near);
        out = endTargets(builder, in);
        return [blocks, out](Backend& backend) {
            const TextureBinding textures[] = {{0, blocks.far}, {1, blocks.near}};
            drawEnds(backend, kLayerSpreadProgram, textures, out, {kOtherSurface, 0.0f, 0.0f, 0.0f});
        };
    });
    return out;
}

} // namespace fx::render
