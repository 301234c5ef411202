#include "rendering/passes/small_media_pass.h"

#include <array>

namespace fx::render {

namespace {
constexpr float kParting =
    0.05f; ///< [1] difference of distances, relative, at which a texel counts a sixteenth
}

ResourceId ReduceDistancePass::addTo(FrameGraph& graph, const Inputs& in)
{
    ResourceId out;
    graph.addPass("reduce distance", [&](FrameGraph::Builder& builder) {
        builder.read(in.distance);
        out = builder.write(builder.create({"small distance", reducedSide(in.width, in.divisor),
                                            reducedSide(in.height, in.divisor), Format::R32F}));
        return [in, target = out](Backend& backend) {
            const std::array<int32_t, 4> size{in.width, in.height, in.divisor, 0};
            const TextureBinding textures[] = {{0, in.distance}};
            DrawCall call;
            call.program = &kReduceDistanceProgram;
            call.targets = {&target, 1};
            call.textures = textures;
            call.uniforms = asUniforms(size);
            backend.draw(call);
        };
    });
    return out;
}

ResourceId EnlargeMediaPass::addTo(FrameGraph& graph, const Inputs& in)
{
    ResourceId out;
    graph.addPass("enlarge media", [&](FrameGraph::Builder& builder) {
        builder.read(in.media);
        builder.read(in.smallDistance);
        builder.read(in.distance);
        out = builder.write(builder.create({"media", in.width, in.height, Format::RGBA32F}));
        return [in, target = out](Backend& backend) {
            const std::array<float, 4> scale{float(in.divisor), kParting, 0.0f, 0.0f};
            const TextureBinding textures[] = {{0, in.media}, {1, in.smallDistance}, {2, in.distance}};
            DrawCall call;
            call.program = &kEnlargeMediaProgram;
            call.targets = {&target, 1};
            call.textures = textures;
            call.uniforms = asUniforms(scale);
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
