#include "rendering/field/field_light_pass.h"

namespace fx::render {

namespace {

constexpr ProgramDesc program(const char* defines)
{
    return {"field light", nullptr, nullptr, "field/field_light.comp.glsl", defines};
}

constexpr ProgramDesc kPrograms[] = {
    program("FX_LAYERS=0 FX_DETAIL=0 FX_NETWORK=0"), program("FX_LAYERS=1 FX_DETAIL=0 FX_NETWORK=0"),
    program("FX_LAYERS=0 FX_DETAIL=1 FX_NETWORK=0"), program("FX_LAYERS=1 FX_DETAIL=1 FX_NETWORK=0"),
    program("FX_LAYERS=0 FX_DETAIL=0 FX_NETWORK=1"), program("FX_LAYERS=1 FX_DETAIL=0 FX_NETWORK=1"),
    program("FX_LAYERS=0 FX_DETAIL=1 FX_NETWORK=1"), program("FX_LAYERS=1 FX_DETAIL=1 FX_NETWORK=1")};

/// What a dispatch reads beside textures; FieldLightBlock in the shader has this layout.
struct Uniforms
{
    glm::vec4 axis;     ///< xyz in which the eye looks; w 1 orthographic
    glm::ivec4 network; ///< x size of a block of moments along x [texel]
};

} // namespace

const ProgramDesc& fieldLightProgram(bool layers, bool detail, bool network)
{
    return kPrograms[(layers ? 1 : 0) + (detail ? 2 : 0) + (network ? 4 : 0)];
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
        for (const ResourceId id : {in.glow, in.grids, in.network})
            if (id.valid())
                builder.read(id);
        out.textures.medium = builder.write(in.textures.medium);
        out.textures.scatter = builder.write(in.textures.scatter);
        const Uniforms uniforms{glm::vec4(glm::vec3(in.view->forward), in.view->rayOrigin.w),
                                glm::ivec4(in.networkBlock, 0, 0, 0)};
        return [in, uniforms, textures = out.textures](Backend& backend) {
            TextureBinding planes[3];
            size_t count = 0;
            if (in.lights.planes.valid())
                planes[count++] = in.lights.textureBinding();
            if (in.lights.hostShadow.valid())
                planes[count++] = in.lights.hostShadowBinding();
            if (in.network.valid() || in.glow.valid())
                planes[count++] = {3, in.network.valid() ? in.network : in.glow, Sampling::Linear};
            const ImageBinding images[] = {{0, textures.medium}, {1, textures.scatter}};
            const BufferBinding buffers[] = {
                {0, in.fields}, {2, in.bricks}, in.lights.bufferBinding(), {3, in.grids}};
            DispatchCall call;
            call.program =
                &fieldLightProgram(textures.shares.valid(), textures.material[0].valid(), in.network.valid());
            call.textures = {planes, count};
            call.images = images;
            call.buffers = std::span(buffers).first(in.grids.valid() ? 4 : 3);
            call.uniforms = asUniforms(uniforms);
            call.groups[0] = in.brickCount;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
