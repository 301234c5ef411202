#include "rendering/lights/slices/light_slices_pass.h"

#include <glm/vec4.hpp>

#include <algorithm>

namespace fx::render {

constexpr ProgramDesc kLightSlicesProgram{"light slices", nullptr, nullptr, "lights/light_slices.comp.glsl",
                                          nullptr};

namespace {

/// Turns of all loops of an invocation. Software renderers end the loops after 65,535 of them without an
/// error, and drivers end dispatches that take seconds.
constexpr uint32_t kMostTurns = 60000;

/// Casters that one dispatch adds: each may lie between all planes.
uint32_t castersPerPass(int planes)
{
    return kMostTurns / uint32_t(planes + 1);
}

} // namespace

LightSlicesPass::Outputs LightSlicesPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.atlas};
    const uint32_t most = castersPerPass(in.mostPlanes);
    uint32_t begin = 0;
    do {
        const glm::ivec4 range(begin, std::min(begin + most, in.casterCount), 0, 0);
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
        begin += most;
    } while (begin < in.casterCount);
    return out;
}

} // namespace fx::render
