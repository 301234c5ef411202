#include "rendering/field/field_light_pass.h"

namespace fx::render {

namespace {

constexpr ProgramDesc kPrograms[] = {
    {"field light", nullptr, nullptr, "field/field_light.comp.glsl", "FX_LAYERS=0\nFX_DETAIL=0"},
    {"field light", nullptr, nullptr, "field/field_light.comp.glsl", "FX_LAYERS=1\nFX_DETAIL=0"},
    {"field light", nullptr, nullptr, "field/field_light.comp.glsl", "FX_LAYERS=0\nFX_DETAIL=1"},
    {"field light", nullptr, nullptr, "field/field_light.comp.glsl", "FX_LAYERS=1\nFX_DETAIL=1"}};

} // namespace

const ProgramDesc& fieldLightProgram(bool layers, bool detail)
{
    return kPrograms[(layers ? 1 : 0) + (detail ? 2 : 0)];
}

FieldLightPass::Outputs FieldLightPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.textures};
    if (!in.lights.lights.valid())
        return out; // nothing is lit: the medium only emits
    graph.addPass("field light", [&](FrameGraph::Builder& builder) {
        builder.read(in.fields);
        builder.read(in.bricks);
        in.lights.read(builder);
        for (const ResourceId id : {in.glow, in.grids})
            if (id.valid())
                builder.read(id);
        out.textures.medium = builder.write(in.textures.medium);
        out.textures.scatter = builder.write(in.textures.scatter);
        const glm::vec4 axis(glm::vec3(in.view->forward), in.view->rayOrigin.w);
        return [in, axis, textures = out.textures](Backend& backend) {
            TextureBinding planes[3];
            size_t count = 0;
            if (in.lights.planes.valid())
                planes[count++] = in.lights.textureBinding();
            if (in.lights.hostShadow.valid())
                planes[count++] = in.lights.hostShadowBinding();
            if (in.glow.valid())
                planes[count++] = {3, in.glow, Sampling::Linear};
            const ImageBinding images[] = {{0, textures.medium}, {1, textures.scatter}};
            const BufferBinding buffers[] = {
                {0, in.fields}, {2, in.bricks}, in.lights.bufferBinding(), {3, in.grids}};
            DispatchCall call;
            call.program = &fieldLightProgram(textures.shares.valid(), textures.material[0].valid());
            call.textures = {planes, count};
            call.images = images;
            call.buffers = std::span(buffers).first(in.grids.valid() ? 4 : 3);
            call.uniforms = asUniforms(axis);
            call.groups[0] = in.brickCount;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
