#include "rendering/lights/slices/light_slices_pass.h"

#include <glm/vec4.hpp>

#include <algorithm>

namespace fx::render {

constexpr ProgramDesc kLightSlicesProgram{"light slices", nullptr, nullptr, "lights/light_slices.comp.glsl",
                                          nullptr};

namespace {

/// Casters that one dispatch adds. A software renderer ends all loops of an invocation after 65,535 turns
/// without a word, a driver a dispatch that takes seconds: of 4096 balls each may lie between 15 planes.
constexpr uint32_t kCastersPerPass = 4096;

} // namespace

LightSlicesPass::Outputs LightSlicesPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.atlas};
    uint32_t begin = 0;
    do {
        const glm::ivec4 range(begin, std::min(begin + kCastersPerPass, in.casterCount), 0, 0);
        graph.addPass("light slices", [&](FrameGraph::Builder& builder) {
            builder.read(in.casters);
            builder.read(in.stacks);
            out.atlas = builder.write(out.atlas);
            return [in, range, atlas = out.atlas](Backend& backend) {
                const ImageBinding images[] = {{0, atlas}};
                const BufferBinding buffers[] = {{0, in.casters}, {1, in.stacks}};
                DispatchCall call;
                call.program = &kLightSlicesProgram;
                call.images = images;
                call.buffers = buffers;
                call.uniforms = asUniforms(range);
                const auto groups = uint32_t(in.mostTexels + 7) / 8;
                call.groups[0] = groups;
                call.groups[1] = groups;
                call.groups[2] = in.stackCount;
                backend.dispatch(call);
            };
        });
        begin += kCastersPerPass;
    } while (begin < in.casterCount);
    return out;
}

} // namespace fx::render
