#include "rendering/passes/layer_resolve_pass.h"

namespace fx::render {

LayerResolvePass::Outputs LayerResolvePass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("layer resolve", [&](FrameGraph::Builder& builder) {
        for (size_t i = MediaPass::Fire; i <= MediaPass::DepthMoment; ++i)
            builder.read(in.layers[i]);
        const auto target = [&](std::string_view name, Format format) {
            return builder.write(builder.create({name, in.width, in.height, format}));
        };
        out.fire = target("fire", Format::RGBA32F);
        out.smoke = target("smoke", Format::RGBA32F);
        out.dust = target("dust", Format::RGBA32F);
        out.media = target("media", Format::RGBA32F);
        out.depth = target("media distance", Format::R32F);

        return [in, out](Backend& backend) {
            const ResourceId targets[] = {out.fire, out.smoke, out.dust, out.media, out.depth};
            const TextureBinding textures[] = {{0, in.layers[MediaPass::Fire]},
                                               {1, in.layers[MediaPass::Smoke]},
                                               {2, in.layers[MediaPass::Dust]},
                                               {3, in.layers[MediaPass::Coverage]},
                                               {4, in.layers[MediaPass::DepthMoment]}};
            DrawCall call;
            call.program = &kLayerResolveProgram;
            call.targets = targets;
            call.textures = textures;
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
