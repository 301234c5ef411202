#include "rendering/passes/heat_shimmer_pass.h"

namespace fx::render {

namespace {

/// Layout of ShimmerBlock in shaders/passes/heat_shimmer.frag.glsl.
struct ShimmerBlock
{
    float strength;
    float maxOffset; ///< [pixel] of the target
    float unused[2];
};
static_assert(sizeof(ShimmerBlock) == 16);

} // namespace

HeatShimmerPass::Outputs HeatShimmerPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.color};
    if (!in.heat.valid() || !(in.settings.strength > 0.0f) || !(in.settings.maxOffset > 0.0f))
        return out;

    graph.addPass("heat shimmer", [&](FrameGraph::Builder& builder) {
        builder.read(in.color);
        builder.read(in.distance);
        builder.read(in.heat);
        out.color =
            builder.write(builder.create(TextureDesc{"shimmered", in.width, in.height, Format::RGBA32F}));
        const ShimmerBlock block{in.settings.strength, in.settings.maxOffset * float(in.height) / 720.0f, {}};
        return [color = in.color, distance = in.distance, heat = in.heat, target = out.color,
                block](Backend& backend) {
            const TextureBinding textures[] = {{0, color}, {1, distance}, {2, heat}};
            DrawCall call;
            call.program = &kHeatShimmerProgram;
            call.targets = {&target, 1};
            call.textures = textures;
            call.uniforms = asUniforms(block);
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
