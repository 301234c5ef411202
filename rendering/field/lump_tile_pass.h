/// @file lump_tile_pass.h
/// The pass that fills the periodic cube of lumps for the detail of fields.
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

constexpr int kLumpTileTexels = 64; ///< along a side: 1 MiB

extern const ProgramDesc kLumpTileProgram;

/// writes  tile  R32F, three-dimensional, kLumpTileTexels a side: lumps of mean 0 and deviation 1, as class
/// LumpTile of
///               rendering/field_detail
/// Formula: lump-noise.
class LumpTilePass
{
public:
    [[nodiscard]] static ResourceId addTo(FrameGraph& graph, ResourceId tile);
};

} // namespace fx::render
