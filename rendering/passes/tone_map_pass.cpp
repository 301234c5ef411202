#include "rendering/passes/tone_map_pass.h"

namespace fx::render {

namespace {

/// Layout of ToneMapBlock in shaders/frame/tone_map.frag.glsl.
struct ToneMapBlock
{
    float white;
    float unused[3];
};
static_assert(sizeof(ToneMapBlock) == 16);

} // namespace

ToneMapPass::Outputs ToneMapPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("tone map", [&](FrameGraph::Builder& builder) {
        builder.read(in.color);
        out.color = builder.write(builder.create(TextureDesc{"display", in.width, in.height, in.format}));
        const ToneMapBlock block{in.white > 1.0f ? in.white : 1.0f, {}};
        const bool dither = in.format == Format::RGBA8;
        return [color = in.color, target = out.color, block, dither](Backend& backend) {
            const TextureBinding textures[] = {{0, color}};
            DrawCall call;
            call.program = dither ? &kToneMapDitherProgram : &kToneMapProgram;
            call.targets = {&target, 1};
            call.textures = textures;
            call.uniforms = asUniforms(block);
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
