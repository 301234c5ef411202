#include "rendering/field/field_glow_pass.h"

#include "rendering/field/field_blocks.h"
#include "rendering/field/field_texels.h"

#include <glm/vec4.hpp>

namespace fx::render {

namespace {

constexpr ProgramDesc kSources[] = {
    {"glow source", nullptr, nullptr, "field/glow_source.comp.glsl", "FX_AGAIN=0\nFX_DETAIL=0"},
    {"glow source", nullptr, nullptr, "field/glow_source.comp.glsl", "FX_AGAIN=0\nFX_DETAIL=1"}};
constexpr ProgramDesc kRays[] = {{"glow rays", nullptr, nullptr, "field/glow_rays.comp.glsl", "FX_AGAIN=0"},
                                 {"glow rays", nullptr, nullptr, "field/glow_rays.comp.glsl", "FX_AGAIN=1"}};
constexpr ProgramDesc kSums[] = {{"glow sum", nullptr, nullptr, "field/glow_sum.comp.glsl", "FX_AGAIN=0"},
                                 {"glow sum", nullptr, nullptr, "field/glow_sum.comp.glsl", "FX_AGAIN=1"}};

constexpr uint32_t kGroup[3] = {8, 4, 2}; ///< invocations, one a cell
constexpr uint32_t kLineRows = 8;         ///< of a group of lines
constexpr uint32_t kNeighbors = 27;       ///< directions, with that of the cell itself

void setGroups(DispatchCall& ioCall, const glm::ivec3& extent)
{
    for (int a = 0; a < 3; ++a)
        ioCall.groups[a] = (uint32_t(extent[a]) + kGroup[a] - 1) / kGroup[a];
}

void addSource(FrameGraph& graph, const FieldGlowPass::Inputs& in, GlowTextures& io)
{
    graph.addPass("glow source", [&](FrameGraph::Builder& builder) {
        for (const ResourceId id :
             {in.fieldTexels, in.field.table, in.grids, in.field.medium, in.field.scatter,
              in.field.material[0], in.field.material[1], in.lumpTile})
            if (id.valid())
                builder.read(id);
        io.cells = builder.write(io.cells);
        io.scatter = builder.write(io.scatter);
        return [in, io](Backend& backend) {
            const glm::ivec4 counts(int(in.fieldCount), int(in.gridCount), 0, 0);
            const TextureBinding textures[] = {
                {0, in.field.medium, Sampling::Linear},      {1, in.field.scatter, Sampling::Linear},
                {kFieldTexelUnit, in.fieldTexels},           {kBrickTableUnit, in.field.table},
                {2, in.field.material[0], Sampling::Linear}, {3, in.field.material[1], Sampling::Linear},
                {10, in.lumpTile, Sampling::LinearRepeat}};
            const ImageBinding images[] = {{0, io.cells}, {1, io.scatter}};
            const BufferBinding buffers[] = {{3, in.grids}};
            DispatchCall call;
            call.program = &glowSourceProgram(in.detail);
            call.textures = std::span(textures).first(in.detail ? 7 : 4);
            call.images = images;
            call.buffers = buffers;
            call.uniforms = asUniforms(counts);
            setGroups(call, in.extent);
            backend.dispatch(call);
        };
    });
}

void addSourceAgain(FrameGraph& graph, const FieldGlowPass::Inputs& in, GlowTextures& io)
{
    graph.addPass("glow source", [&](FrameGraph::Builder& builder) {
        for (const ResourceId id : {io.scatter, io.first})
            builder.read(id);
        io.cells = builder.write(io.cells);
        return [in, io](Backend& backend) {
            const TextureBinding textures[] = {{3, io.scatter}, {4, io.first}};
            const ImageBinding images[] = {{0, io.cells}};
            DispatchCall call;
            call.program = &kGlowSourceAgainProgram;
            call.textures = textures;
            call.images = images;
            setGroups(call, in.extent);
            backend.dispatch(call);
        };
    });
}

void addRays(FrameGraph& graph, const FieldGlowPass::Inputs& in, bool again, GlowTextures& io)
{
    graph.addPass("glow rays", [&](FrameGraph::Builder& builder) {
        builder.read(in.grids);
        builder.read(io.cells);
        io.rays = builder.write(io.rays);
        return [in, io, again](Backend& backend) {
            const TextureBinding textures[] = {{0, io.cells}};
            const ImageBinding images[] = {{0, io.rays}};
            const BufferBinding buffers[] = {{3, in.grids}};
            DispatchCall call;
            call.program = &glowRaysProgram(again);
            call.textures = textures;
            call.images = images;
            call.buffers = buffers;
            call.groups[1] = 3 * uint32_t(kGlowCells) / kLineRows;
            call.groups[2] = in.gridCount * kNeighbors;
            backend.dispatch(call);
        };
    });
}

void addSum(FrameGraph& graph, const FieldGlowPass::Inputs& in, bool again, GlowTextures& io)
{
    graph.addPass("glow sum", [&](FrameGraph::Builder& builder) {
        builder.read(io.rays);
        if (again)
            for (const ResourceId id : {io.first, io.scatter, io.cells})
                builder.read(id);
        ResourceId& light = again ? io.light : io.first;
        light = builder.write(light);
        return [in, io, again, light](Backend& backend) {
            const TextureBinding textures[] = {{0, io.rays}, {4, io.first}, {3, io.scatter}, {1, io.cells}};
            const ImageBinding images[] = {{0, light}};
            DispatchCall call;
            call.program = &glowSumProgram(again);
            call.textures = std::span(textures).first(again ? 4 : 1);
            call.images = images;
            setGroups(call, in.extent);
            backend.dispatch(call);
        };
    });
}

} // namespace

constexpr ProgramDesc kGlowSourceAgainProgram{"glow source", nullptr, nullptr, "field/glow_source.comp.glsl",
                                              "FX_AGAIN=1\nFX_DETAIL=0"};

const ProgramDesc& glowRaysProgram(bool again)
{
    return kRays[again ? 1 : 0];
}

const ProgramDesc& glowSourceProgram(bool detail)
{
    return kSources[detail ? 1 : 0];
}

const ProgramDesc& glowSumProgram(bool again)
{
    return kSums[again ? 1 : 0];
}

GlowTextures FieldGlowPass::addSourcesTo(FrameGraph& graph, const Inputs& in)
{
    GlowTextures out = in.glow;
    addSource(graph, in, out);
    return out;
}

FieldGlowPass::Outputs FieldGlowPass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.glow};
    addSource(graph, in, out.glow);
    addRays(graph, in, false, out.glow);
    addSum(graph, in, false, out.glow);
    addSourceAgain(graph, in, out.glow);
    addRays(graph, in, true, out.glow);
    addSum(graph, in, true, out.glow);
    return out;
}

} // namespace fx::render
