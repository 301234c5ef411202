#include "rendering/field/field_fill_pass.h"

namespace fx::render {

namespace {

constexpr ProgramDesc kPrograms[] = {
    {"field fill", nullptr, nullptr, "field/field_fill.comp.glsl", "FX_LAYERS=0"},
    {"field fill", nullptr, nullptr, "field/field_fill.comp.glsl", "FX_LAYERS=1"}};

} // namespace

const ProgramDesc& fieldFillProgram(bool layers)
{
    return kPrograms[layers ? 1 : 0];
}

FieldFillPass::Outputs FieldFillPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.textures};
    graph.addPass("field fill", [&](FrameGraph::Builder& builder) {
        for (const ResourceId buffer : {in.balls, in.fields, in.bricks, in.brickBalls})
            builder.read(buffer);
        for (ResourceId* texture : {&out.textures.medium, &out.textures.scatter, &out.textures.shares})
            if (texture->valid())
                *texture = builder.write(*texture);
        return [in, textures = out.textures](Backend& backend) {
            const bool layers = textures.shares.valid();
            const ImageBinding images[] = {{0, textures.medium}, {1, textures.scatter}, {2, textures.shares}};
            const BufferBinding buffers[] = {
                {0, in.balls}, {1, in.fields}, {2, in.bricks}, {3, in.brickBalls}};
            DispatchCall call;
            call.program = &fieldFillProgram(layers);
            call.images = std::span(images).first(layers ? 3 : 2);
            call.buffers = buffers;
            call.groups[0] = in.brickCount;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
