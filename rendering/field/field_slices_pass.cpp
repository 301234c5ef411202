#include "rendering/field/field_slices_pass.h"

#include "rendering/field/field_texels.h"

#include <glm/vec4.hpp>

namespace fx::render {

constexpr ProgramDesc kFieldSlicesProgram{"field slices", nullptr, nullptr, "field/field_slices.comp.glsl",
                                          nullptr};

LightBindings FieldSlicesPass::addTo(FrameGraph& graph, const Inputs& in)
{
    LightBindings out = in.lights;
    graph.addPass("field slices", [&](FrameGraph::Builder& builder) {
        for (const ResourceId id : {in.fieldTexels, in.table, in.change, in.stacks})
            builder.read(id);
        out.planes = builder.write(in.lights.planes);
        return [in, planes = out.planes](Backend& backend) {
            const glm::ivec4 counts(int(in.fieldCount), 0, 0, 0);
            const TextureBinding textures[] = {{1, in.change, Sampling::Linear},
                                               {kFieldTexelUnit, in.fieldTexels},
                                               {kBrickTableUnit, in.table}};
            const ImageBinding images[] = {{0, planes}};
            const BufferBinding buffers[] = {{1, in.stacks}};
            DispatchCall call;
            call.program = &kFieldSlicesProgram;
            call.textures = textures;
            call.images = images;
            call.buffers = buffers;
            call.uniforms = asUniforms(counts);
            const auto groups = uint32_t(in.lights.mostTexels + 7) / 8;
            call.groups[0] = groups;
            call.groups[1] = groups;
            call.groups[2] = in.stackCount;
            backend.dispatch(call);
        };
    });
    graph.keep(out.planes); // later frames read it
    return out;
}

} // namespace fx::render
