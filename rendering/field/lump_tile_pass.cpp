#include "rendering/field/lump_tile_pass.h"

namespace fx::render {

namespace {

constexpr uint32_t kTexelsOfGroup = 4; ///< along a side

} // namespace

constexpr ProgramDesc kLumpTileProgram{"lump tile", nullptr, nullptr, "field/lump_tile.comp.glsl", nullptr};

ResourceId LumpTilePass::addTo(FrameGraph& graph, ResourceId tile)
{
    ResourceId written;
    graph.addPass("lump tile", [&](FrameGraph::Builder& builder) {
        written = builder.write(tile);
        return [written](Backend& backend) {
            const ImageBinding images[] = {{0, written}};
            DispatchCall call;
            call.program = &kLumpTileProgram;
            call.images = images;
            for (uint32_t& groups : call.groups)
                groups = uint32_t(kLumpTileTexels) / kTexelsOfGroup;
            backend.dispatch(call);
        };
    });
    return written;
}

} // namespace fx::render
