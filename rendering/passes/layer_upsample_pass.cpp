#include "rendering/passes/layer_upsample_pass.h"

namespace fx::render {

LayerUpsamplePass::Outputs LayerUpsamplePass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("layer upsample", [&](FrameGraph::Builder& builder) {
        builder.read(in.sceneDistance);
        builder.read(in.far);
        builder.read(in.farLight);
        const bool hasNear = in.nearLight.valid();
        if (hasNear) {
            builder.read(in.near);
            builder.read(in.nearLight);
        }
        out.light = builder.write(builder.create(TextureDesc{in.name, in.width, in.height, in.format}));
        return [in, hasNear, target = out.light](Backend& backend) {
            /// Layout of UpsampleBlock in shaders/frame/layer_upsample.frag.glsl.
            const float block[4] = {float(in.divisor), kUpsampleReach, hasNear ? 1.0f : 0.0f, 0.0f};
            const TextureBinding textures[] = {{0, in.sceneDistance},
                                               {1, in.far},
                                               {2, in.farLight},
                                               {3, hasNear ? in.near : in.far},
                                               {4, hasNear ? in.nearLight : in.farLight}};
            DrawCall call;
            call.program = &kLayerUpsampleProgram;
            call.targets = {&target, 1};
            call.textures = textures;
            call.uniforms = asUniforms(block);
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
