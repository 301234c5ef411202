#include "rendering/passes/present_pass.h"

namespace fx::render {

PresentPass::Outputs PresentPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("present", [&](FrameGraph::Builder& builder) {
        builder.read(in.picture);
        out.target = builder.write(in.target);
        return [picture = in.picture, target = out.target](Backend& backend) {
            const TextureBinding textures[] = {{0, picture}};
            DrawCall call;
            call.program = &kPresentProgram;
            call.targets = {&target, 1};
            call.textures = textures;
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
