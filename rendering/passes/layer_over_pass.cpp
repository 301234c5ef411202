#include "rendering/passes/layer_over_pass.h"

namespace fx::render {

LayerOverPass::Layers LayerOverPass::addTo(FrameGraph& graph, const Layers& over, const Layers& under)
{
    Layers out;
    graph.addPass("layer over", [&](FrameGraph::Builder& builder) {
        for (size_t i = 0; i < out.size(); ++i) {
            builder.read(over[i]);
            out[i] = builder.write(under[i]);
        }
        return [over, out](Backend& backend) {
            std::array<TextureBinding, MediaPass::LayerTargets> textures;
            for (size_t i = 0; i < textures.size(); ++i)
                textures[i] = {uint32_t(i), over[i]};
            DrawCall call;
            call.program = &kLayerOverProgram;
            call.targets = out;
            call.textures = textures;
            call.blend = Blend::Premultiplied;
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
