#include "rendering/field/field_volume_pass.h"

#include "rendering/field/field_texels.h"

namespace fx::render {

namespace {

constexpr ProgramDesc kPrograms[] = {
    {"field volume", nullptr, nullptr, "field/field_volume.comp.glsl", "FX_LAYERS=0"},
    {"field volume", nullptr, nullptr, "field/field_volume.comp.glsl", "FX_LAYERS=1"}};

} // namespace

const ProgramDesc& fieldVolumeProgram(bool layers)
{
    return kPrograms[layers ? 1 : 0];
}

FieldVolumePass::Outputs FieldVolumePass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.textures};
    graph.addPass("field volume", [&](FrameGraph::Builder& builder) {
        for (const ResourceId id : {in.balls, in.fieldTexels, in.bricks, in.brickBalls, in.index, in.voxels})
            builder.read(id);
        for (ResourceId* texture : {&out.textures.medium, &out.textures.scatter, &out.textures.shares,
                                    &out.textures.table, &out.textures.change})
            if (texture->valid())
                *texture = builder.write(*texture);
        return [in, textures = out.textures](Backend& backend) {
            const bool layers = textures.shares.valid();
            const ImageBinding images[] = {{0, textures.medium},
                                           {1, textures.scatter},
                                           {5, textures.table},
                                           {6, textures.change},
                                           {2, textures.shares}};
            const BufferBinding buffers[] = {
                {0, in.balls}, {2, in.bricks}, {3, in.brickBalls}, {4, in.index}, {5, in.voxels}};
            const TextureBinding read[] = {{kFieldTexelUnit, in.fieldTexels}};
            DispatchCall call;
            call.program = &fieldVolumeProgram(layers);
            call.images = std::span(images).first(layers ? 5 : 4);
            call.buffers = buffers;
            call.textures = read;
            call.uniforms = asUniforms(in.block);
            call.groups[0] = in.brickCount;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
