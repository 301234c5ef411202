#include "rendering/passes/heat_shimmer_pass.h"

#include <bit>

namespace fx::render {

namespace {

/// Layout of ShimmerBlock in shaders/shimmer/shimmer_block.glsl.
struct ShimmerBlock
{
    float strength;
    float maxOffset;     ///< [pixel] of the target
    float width, height; ///< [pixel]
    float flip;          ///< of window y against clip y, 1 or -1
    float unused[3];
};
static_assert(sizeof(ShimmerBlock) == 32);

void drawAreas(Backend& backend, const ProgramDesc& program, std::span<const TextureBinding> textures,
               ResourceId areas, uint32_t count, const ShimmerBlock& block, const ResourceId& target)
{
    const BufferBinding buffers[] = {{0, areas}};
    DrawCall call;
    call.program = &program;
    call.targets = {&target, 1};
    call.textures = textures;
    call.buffers = buffers;
    call.uniforms = asUniforms(block);
    call.vertices = 6;
    call.instances = count;
    backend.draw(call);
}

} // namespace

HeatShimmerPass::Outputs HeatShimmerPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.color};
    if (!in.heat.valid() || in.areas.empty() || !(in.settings.strength > 0.0f) ||
        !(in.settings.maxOffset > 0.0f))
        return out;

    const ShimmerBlock block{in.settings.strength,
                             in.settings.maxOffset * float(in.height) / 720.0f,
                             float(in.width),
                             float(in.height),
                             in.upperLeftOrigin ? -1.0f : 1.0f,
                             {}};
    const uint32_t count = uint32_t(in.areas.size());
    ResourceId areas;
    ResourceId displaced;
    graph.addPass("heat shimmer", [&](FrameGraph::Builder& builder) {
        builder.read(in.color);
        builder.read(in.distance);
        builder.read(in.heat);
        areas = builder.write(builder.create(BufferDesc{"hot areas", std::bit_ceil(in.areas.size_bytes())}));
        displaced =
            builder.write(builder.create(TextureDesc{"shimmered", in.width, in.height, Format::RGBA32F}));
        return [color = in.color, distance = in.distance, heat = in.heat, given = in.areas, areas, displaced,
                count, block](Backend& backend) {
            backend.upload(areas, std::as_bytes(given));
            const TextureBinding textures[] = {{0, color}, {1, distance}, {2, heat}};
            drawAreas(backend, kHeatShimmerProgram, textures, areas, count, block, displaced);
        };
    });
    graph.addPass("heat shimmer back", [&](FrameGraph::Builder& builder) {
        builder.read(areas);
        builder.read(displaced);
        out.color = builder.write(in.color);
        return [areas, displaced, target = out.color, count, block](Backend& backend) {
            const TextureBinding textures[] = {{0, displaced}};
            drawAreas(backend, kHeatShimmerBackProgram, textures, areas, count, block, target);
        };
    });
    return out;
}

} // namespace fx::render
