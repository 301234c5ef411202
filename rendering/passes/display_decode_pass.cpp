#include "rendering/passes/display_decode_pass.h"

namespace fx::render {

DisplayDecodePass::Outputs DisplayDecodePass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("display decode", [&](FrameGraph::Builder& builder) {
        builder.read(in.picture);
        out.color =
            builder.write(builder.create(TextureDesc{"decoded", in.width, in.height, Format::RGBA32F}));
        return [picture = in.picture, target = out.color, block = in.block](Backend& backend) {
            const TextureBinding textures[] = {{0, picture}};
            DrawCall call;
            call.program = &kDisplayDecodeProgram;
            call.targets = {&target, 1};
            call.textures = textures;
            call.uniforms = asUniforms(block);
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
