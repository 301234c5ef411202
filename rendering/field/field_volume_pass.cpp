#include "rendering/field/field_volume_pass.h"

#include "rendering/field/field_texels.h"

#include <array>

namespace fx::render {

namespace {

constexpr const char* kVariants[] = {
    "FX_LAYERS=0 FX_BETWEEN=0 FX_DETAIL=0", "FX_LAYERS=1 FX_BETWEEN=0 FX_DETAIL=0",
    "FX_LAYERS=0 FX_BETWEEN=1 FX_DETAIL=0", "FX_LAYERS=1 FX_BETWEEN=1 FX_DETAIL=0",
    "FX_LAYERS=0 FX_BETWEEN=0 FX_DETAIL=1", "FX_LAYERS=1 FX_BETWEEN=0 FX_DETAIL=1",
    "FX_LAYERS=0 FX_BETWEEN=1 FX_DETAIL=1", "FX_LAYERS=1 FX_BETWEEN=1 FX_DETAIL=1"};

constexpr ProgramDesc programOf(size_t variant)
{
    return {"field volume", nullptr, nullptr, "field/field_volume.comp.glsl", kVariants[variant]};
}

constexpr ProgramDesc kPrograms[] = {programOf(0), programOf(1), programOf(2), programOf(3),
                                     programOf(4), programOf(5), programOf(6), programOf(7)};

} // namespace

const ProgramDesc& fieldVolumeProgram(bool layers, bool between, bool detail)
{
    return kPrograms[(layers ? 1 : 0) + (between ? 2 : 0) + (detail ? 4 : 0)];
}

FieldVolumePass::Outputs FieldVolumePass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.textures};
    graph.addPass("field volume", [&](FrameGraph::Builder& builder) {
        for (const ResourceId id : {in.balls, in.fieldTexels, in.bricks, in.brickBalls, in.index[0],
                                    in.voxels[0], in.index[1], in.voxels[1]})
            if (id.valid())
                builder.read(id);
        for (ResourceId* texture :
             {&out.textures.medium, &out.textures.scatter, &out.textures.shares, &out.textures.table,
              &out.textures.change, &out.textures.material[0], &out.textures.material[1]})
            if (texture->valid())
                *texture = builder.write(*texture);
        return [in, textures = out.textures](Backend& backend) {
            const bool layers = textures.shares.valid(), between = in.index[1].valid();
            const bool detail = textures.material[0].valid();
            std::array<ImageBinding, 7> images{
                {{0, textures.medium}, {1, textures.scatter}, {5, textures.table}, {6, textures.change}}};
            size_t count = 4;
            if (layers)
                images[count++] = {2, textures.shares};
            for (uint32_t g = 0; detail && g < 2; ++g)
                images[count++] = {3 + g, textures.material[g]};
            const BufferBinding buffers[] = {
                {0, in.balls}, {2, in.bricks}, {3, in.brickBalls}, {4, in.index[0]}, {5, in.index[1]}};
            const TextureBinding read[] = {
                {kFieldTexelUnit, in.fieldTexels}, {0, in.voxels[0]}, {1, in.voxels[1]}};
            DispatchCall call;
            call.program = &fieldVolumeProgram(layers, between, detail);
            call.images = std::span(images).first(count);
            call.buffers = std::span(buffers).first(between ? 5 : 4);
            call.textures = std::span(read).first(between ? 3 : 2);
            call.uniforms = asUniforms(in.block);
            call.groups[0] = in.brickCount;
            backend.dispatch(call);
        };
    });
    return out;
}

} // namespace fx::render
