#include "rendering/field/field_fill_pass.h"

#include "rendering/field/field_texels.h"

namespace fx::render {

namespace {

constexpr ProgramDesc kPrograms[] = {
    {"field fill", nullptr, nullptr, "field/field_fill.comp.glsl", "FX_LAYERS=0\nFX_DETAIL=0"},
    {"field fill", nullptr, nullptr, "field/field_fill.comp.glsl", "FX_LAYERS=1\nFX_DETAIL=0"},
    {"field fill", nullptr, nullptr, "field/field_fill.comp.glsl", "FX_LAYERS=0\nFX_DETAIL=1"},
    {"field fill", nullptr, nullptr, "field/field_fill.comp.glsl", "FX_LAYERS=1\nFX_DETAIL=1"}};

} // namespace

const ProgramDesc& fieldFillProgram(bool layers, bool detail)
{
    return kPrograms[(layers ? 1 : 0) + (detail ? 2 : 0)];
}

FieldFillPass::Outputs FieldFillPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.textures};
    graph.addPass("field fill", [&](FrameGraph::Builder& builder) {
        for (const ResourceId id : {in.balls, in.fieldTexels, in.bricks, in.brickBalls})
            builder.read(id);
        for (const ResourceId id : {in.materials, in.lumpTile})
            if (id.valid())
                builder.read(id);
        for (ResourceId* texture :
             {&out.textures.medium, &out.textures.scatter, &out.textures.shares, &out.textures.table,
              &out.textures.material[0], &out.textures.material[1], &out.textures.change})
            if (texture->valid())
                *texture = builder.write(*texture);
        return [in, textures = out.textures](Backend& backend) {
            const bool layers = textures.shares.valid();
            const bool detail = in.materials.valid();
            backend.clear(textures.table, {0.0f, 0.0f, 0.0f, 0.0f});
            ImageBinding images[7] = {{0, textures.medium}, {1, textures.scatter}, {5, textures.table}};
            size_t count = 3;
            if (layers)
                images[count++] = {2, textures.shares};
            for (uint32_t g = 0; detail && g < 2; ++g)
                images[count++] = {3 + g, textures.material[g]};
            if (detail)
                images[count++] = {6, textures.change};
            const BufferBinding buffers[] = {
                {0, in.balls}, {2, in.bricks}, {3, in.brickBalls}, {4, in.materials}};
            const TextureBinding read[] = {{kFieldTexelUnit, in.fieldTexels},
                                           {10, in.lumpTile, Sampling::LinearRepeat}};
            DispatchCall call;
            call.program = &fieldFillProgram(layers, detail);
            call.images = std::span(images).first(count);
            call.buffers = std::span(buffers).first(detail ? 4 : 3);
            call.textures = std::span(read).first(detail ? 2 : 1);
            call.groups[0] = in.brickCount;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
