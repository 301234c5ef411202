#include "rendering/lights/slices/light_slices_pass.h"

#include <glm/vec4.hpp>

namespace fx::render {

constexpr ProgramDesc kLightSlicesProgram{"light slices", nullptr, nullptr, "lights/light_slices.comp.glsl",
                                          nullptr};

LightSlicesPass::Outputs LightSlicesPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    graph.addPass("light slices", [&](FrameGraph::Builder& builder) {
        builder.read(in.casters);
        builder.read(in.stacks);
        out.atlas = builder.write(in.atlas);
        return [in, atlas = out.atlas](Backend& backend) {
            const glm::ivec4 counts(int(in.casterCount), 0, 0, 0);
            const ImageBinding images[] = {{0, atlas}};
            const BufferBinding buffers[] = {{0, in.casters}, {1, in.stacks}};
            DispatchCall call;
            call.program = &kLightSlicesProgram;
            call.images = images;
            call.buffers = buffers;
            call.uniforms = asUniforms(counts);
            const auto groups = uint32_t(in.mostTexels + 7) / 8;
            call.groups[0] = groups;
            call.groups[1] = groups;
            call.groups[2] = in.stackCount;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
