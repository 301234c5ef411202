#include "rendering/passes/overdraw_pass.h"

namespace fx::render {

OverdrawPass::Outputs OverdrawPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("overdraw", [&](FrameGraph::Builder& builder) {
        builder.read(in.blobs);
        builder.read(in.distance);
        out.count = builder.write(builder.create({"overdraw", in.width, in.height, Format::R32F}));
        return [in, target = out.count](Backend& backend) {
            backend.clear(target, {0.0f, 0.0f, 0.0f, 0.0f});
            const TextureBinding textures[] = {{0, in.distance}};
            const BufferBinding buffers[] = {{0, in.blobs}};
            DrawCall call;
            call.program = in.isSmall ? &kOverdrawSmallProgram : &kOverdrawProgram;
            call.targets = {&target, 1};
            call.textures = textures;
            call.buffers = buffers;
            call.uniforms = asUniforms(in.view);
            call.blend = Blend::Additive;
            call.vertices = 6;
            call.instances = in.count;
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
