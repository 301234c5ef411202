#include "rendering/passes/scene_distance_pass.h"

#include <limits>

namespace fx::render {

SceneDistancePass::Outputs SceneDistancePass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("scene distance", [&](FrameGraph::Builder& builder) {
        if (in.depth.valid())
            builder.read(in.depth);
        out.distance = builder.write(builder.create({"scene distance", in.width, in.height, Format::R32F}));
        return [depth = in.depth, view = in.view, target = out.distance](Backend& backend) {
            if (!depth.valid()) {
                constexpr float kFar = std::numeric_limits<float>::infinity();
                backend.clear(target, {kFar, kFar, kFar, kFar});
                return;
            }
            const TextureBinding textures[] = {{0, depth}};
            DrawCall call;
            call.program = &kSceneDistanceProgram;
            call.targets = {&target, 1};
            call.textures = textures;
            call.uniforms = asUniforms(view);
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
