#include "rendering/field/field_near_pass.h"

#include "rendering/field/field_texels.h"

namespace fx::render {

namespace {

constexpr ProgramDesc kPrograms[] = {
    {"field near", nullptr, nullptr, "field/field_near.comp.glsl", "FX_LAYERS=0 FX_DETAIL=0"},
    {"field near", nullptr, nullptr, "field/field_near.comp.glsl", "FX_LAYERS=1 FX_DETAIL=0"}};

} // namespace

constexpr ProgramDesc kFieldNearDetailProgram{"field near", nullptr, nullptr, "field/field_near.comp.glsl",
                                              "FX_LAYERS=0 FX_DETAIL=1"};

const ProgramDesc& fieldNearProgram(bool layers)
{
    return kPrograms[layers ? 1 : 0];
}

FieldNearPass::Outputs FieldNearPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.textures};
    graph.addPass("field near", [&](FrameGraph::Builder& builder) {
        for (const ResourceId id : {in.balls, in.fieldTexels, in.bricks, in.nearBricks, in.nearParts})
            builder.read(id);
        out.textures.medium = builder.write(out.textures.medium);
        if (!in.detail)
            for (ResourceId* texture : {&out.textures.scatter, &out.textures.shares})
                if (texture->valid())
                    *texture = builder.write(*texture);
        return [in, textures = out.textures](Backend& backend) {
            const bool layers = textures.shares.valid() && !in.detail;
            const ImageBinding images[] = {{0, textures.medium}, {1, textures.scatter}, {2, textures.shares}};
            const BufferBinding buffers[] = {
                {0, in.balls}, {2, in.bricks}, {3, in.nearBricks}, {4, in.nearParts}};
            const TextureBinding read[] = {{kFieldTexelUnit, in.fieldTexels}};
            DispatchCall call;
            call.program = in.detail ? &kFieldNearDetailProgram : &fieldNearProgram(layers);
            call.images = std::span(images).first(in.detail ? 1 : layers ? 3 : 2);
            call.buffers = buffers;
            call.textures = read;
            call.groups[0] = in.nearBrickCount;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
