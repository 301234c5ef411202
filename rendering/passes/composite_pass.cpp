#include "rendering/passes/composite_pass.h"

namespace fx::render {

CompositePass::Outputs CompositePass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("composite", [&](FrameGraph::Builder& builder) {
        builder.read(in.media);
        if (in.inPlace) {
            out.color = builder.write(in.picture);
        } else {
            builder.read(in.picture);
            out.color = builder.write(builder.create({"color", in.width, in.height, Format::RGBA32F}));
        }
        return [in, target = out.color](Backend& backend) {
            const bool hasBlock = in.display.has_value();
            const TextureBinding textures[] = {{0, in.media}, {1, in.picture}};
            DrawCall call;
            call.program = in.inPlace ? (hasBlock ? &kCompositeOffsetProgram : &kCompositeBlendProgram)
                                      : (hasBlock ? &kCompositeDisplayProgram : &kCompositeProgram);
            if (hasBlock)
                call.uniforms = asUniforms(*in.display);
            call.targets = {&target, 1};
            call.textures = {textures, in.inPlace ? size_t(1) : size_t(2)};
            call.blend = in.inPlace ? Blend::Premultiplied : Blend::None;
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
