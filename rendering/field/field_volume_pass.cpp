#include "rendering/field/field_volume_pass.h"

#include "rendering/field/field_texels.h"

namespace fx::render {

namespace {

constexpr ProgramDesc kPrograms[] = {
    {"field volume", nullptr, nullptr, "field/field_volume.comp.glsl", "FX_LAYERS=0 FX_BETWEEN=0"},
    {"field volume", nullptr, nullptr, "field/field_volume.comp.glsl", "FX_LAYERS=1 FX_BETWEEN=0"},
    {"field volume", nullptr, nullptr, "field/field_volume.comp.glsl", "FX_LAYERS=0 FX_BETWEEN=1"},
    {"field volume", nullptr, nullptr, "field/field_volume.comp.glsl", "FX_LAYERS=1 FX_BETWEEN=1"}};

} // namespace

const ProgramDesc& fieldVolumeProgram(bool layers, bool between)
{
    return kPrograms[(layers ? 1 : 0) + (between ? 2 : 0)];
}

FieldVolumePass::Outputs FieldVolumePass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.textures};
    graph.addPass("field volume", [&](FrameGraph::Builder& builder) {
        for (const ResourceId id : {in.balls, in.fieldTexels, in.bricks, in.brickBalls, in.index[0],
                                    in.voxels[0], in.index[1], in.voxels[1]})
            if (id.valid())
                builder.read(id);
        for (ResourceId* texture : {&out.textures.medium, &out.textures.scatter, &out.textures.shares,
                                    &out.textures.table, &out.textures.change})
            if (texture->valid())
                *texture = builder.write(*texture);
        return [in, textures = out.textures](Backend& backend) {
            const bool layers = textures.shares.valid(), between = in.index[1].valid();
            const ImageBinding images[] = {{0, textures.medium},
                                           {1, textures.scatter},
                                           {5, textures.table},
                                           {6, textures.change},
                                           {2, textures.shares}};
            const BufferBinding buffers[] = {{0, in.balls},    {2, in.bricks},    {3, in.brickBalls},
                                             {4, in.index[0]}, {5, in.voxels[0]}, {6, in.index[1]},
                                             {7, in.voxels[1]}};
            const TextureBinding read[] = {{kFieldTexelUnit, in.fieldTexels}};
            DispatchCall call;
            call.program = &fieldVolumeProgram(layers, between);
            call.images = std::span(images).first(layers ? 5 : 4);
            call.buffers = std::span(buffers).first(between ? 7 : 5);
            call.textures = read;
            call.uniforms = asUniforms(in.block);
            call.groups[0] = in.brickCount;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
