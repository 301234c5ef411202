#include "rendering/passes/present_changes_pass.h"

namespace fx::render {

PresentChangesPass::Outputs PresentChangesPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("present changes", [&](FrameGraph::Builder& builder) {
        builder.read(in.picture);
        builder.read(in.before);
        const bool isWhole = in.block.whole != 0;
        if (isWhole)
            builder.read(in.original);
        out.target = builder.write(in.target);
        return [picture = in.picture, before = in.before, original = in.original, target = out.target,
                block = in.block, isWhole](Backend& backend) {
            const TextureBinding textures[] = {{0, picture}, {1, before}, {2, original}};
            DrawCall call;
            call.program = &kPresentChangesProgram;
            call.targets = {&target, 1};
            call.textures = {textures, isWhole ? size_t(3) : size_t(2)};
            call.uniforms = asUniforms(block);
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
