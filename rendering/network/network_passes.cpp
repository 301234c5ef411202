#include "rendering/network/network_passes.h"

#include <glm/vec4.hpp>

#include <algorithm>

namespace fx::render {

namespace {

constexpr uint32_t kGroup[3] = {8, 4, 2}; // invocations, one a cell
constexpr uint32_t kLineGroup = 64;       // invocations, one a line
constexpr uint32_t kDirections = 26;

uint32_t groupsFor(uint32_t count, uint32_t group)
{
    return (count + group - 1) / group;
}

void setGroups(DispatchCall& ioCall, const NetworkPasses::Inputs& in)
{
    for (int a = 0; a < 3; ++a)
        ioCall.groups[a] = groupsFor(uint32_t(in.extent[a]), kGroup[a]);
}

/// NetworkBlock of the shaders.
glm::ivec4 networkBlock(const NetworkPasses::Inputs& in)
{
    return {in.block.x, in.block.y, int(in.gridCount), 0};
}

void addPrepare(FrameGraph& graph, const NetworkPasses::Inputs& in, NetworkTextures& io)
{
    graph.addPass("network prepare", [&](FrameGraph::Builder& builder) {
        for (const ResourceId id : {in.grids, io.cells, io.scatter, io.before})
            builder.read(id);
        in.lights.read(builder);
        for (ResourceId* id : {&io.medium, &io.unswept, &io.sources})
            *id = builder.write(*id);
        return [in, io](Backend& backend) {
            TextureBinding textures[5] = {{0, io.cells}, {1, io.scatter}, {2, io.before, Sampling::Linear}};
            size_t count = 3;
            if (in.lights.planes.valid())
                textures[count++] = in.lights.textureBinding();
            if (in.lights.hostShadow.valid())
                textures[count++] = in.lights.hostShadowBinding();
            const ImageBinding images[] = {{0, io.medium}, {1, io.unswept}, {2, io.sources}};
            const BufferBinding buffers[] = {in.lights.bufferBinding(), {3, in.grids}};
            const glm::ivec4 network = networkBlock(in);
            DispatchCall call;
            call.program = &kNetworkPrepareProgram;
            call.textures = {textures, count};
            call.images = images;
            call.buffers = buffers;
            call.uniforms = asUniforms(network);
            setGroups(call, in);
            backend.dispatch(call);
        };
    });
}

void addRays(FrameGraph& graph, const NetworkPasses::Inputs& in, NetworkTextures& io)
{
    graph.addPass("network rays", [&](FrameGraph::Builder& builder) {
        for (const ResourceId id : {in.grids, in.lights.lights, io.medium, io.sources})
            builder.read(id);
        io.rays = builder.write(io.rays);
        return [in, io](Backend& backend) {
            const TextureBinding textures[] = {{0, io.medium}, {1, io.sources}};
            const ImageBinding images[] = {{0, io.rays}};
            const BufferBinding buffers[] = {in.lights.bufferBinding(), {3, in.grids}};
            const glm::ivec4 network = networkBlock(in);
            DispatchCall call;
            call.program = &kNetworkRaysProgram;
            call.textures = textures;
            call.images = images;
            call.buffers = buffers;
            call.uniforms = asUniforms(network);
            call.groups[0] = groupsFor(in.mostLines, kLineGroup);
            call.groups[2] = in.gridCount * kDirections;
            backend.dispatch(call);
        };
    });
}

void addSum(FrameGraph& graph, const NetworkPasses::Inputs& in, NetworkTextures& io)
{
    graph.addPass("network sum", [&](FrameGraph::Builder& builder) {
        for (const ResourceId id : {in.grids, io.rays, io.medium, io.unswept})
            builder.read(id);
        io.moments = builder.write(io.moments);
        io.sources = builder.write(io.sources);
        return [in, io](Backend& backend) {
            const TextureBinding textures[] = {{0, io.rays}, {1, io.medium}, {2, io.unswept}};
            const ImageBinding images[] = {{0, io.moments}, {1, io.sources}};
            const BufferBinding buffers[] = {{3, in.grids}};
            const glm::ivec4 network = networkBlock(in);
            DispatchCall call;
            call.program = &kNetworkSumProgram;
            call.textures = textures;
            call.images = images;
            call.buffers = buffers;
            call.uniforms = asUniforms(network);
            setGroups(call, in);
            backend.dispatch(call);
        };
    });
}

} // namespace

constexpr ProgramDesc kNetworkPrepareProgram{"network prepare", nullptr, nullptr,
                                             "network/network_prepare.comp.glsl", nullptr};
constexpr ProgramDesc kNetworkRaysProgram{"network rays", nullptr, nullptr, "network/network_rays.comp.glsl",
                                          nullptr};
constexpr ProgramDesc kNetworkSumProgram{"network sum", nullptr, nullptr, "network/network_sum.comp.glsl",
                                         nullptr};

uint32_t mostNetworkLines(std::span<const FieldGlowBlock> grids)
{
    int most = 0;
    for (const FieldGlowBlock& grid : grids) {
        const glm::ivec4& c = grid.cells;
        most = std::max(most, c.x * c.y + c.x * c.z + c.y * c.z);
    }
    return uint32_t(most);
}

NetworkPasses::Outputs NetworkPasses::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.textures};
    if (in.prepares)
        addPrepare(graph, in, out.textures);
    for (int i = 0; i < in.sweeps; ++i) {
        addRays(graph, in, out.textures);
        addSum(graph, in, out.textures);
    }
    return out;
}

} // namespace fx::render
