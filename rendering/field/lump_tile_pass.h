/// @file lump_tile_pass.h
/// The pass that fills the periodic cube of noise for the detail of fields.
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

constexpr int kLumpTileTexels = 64; ///< number of texels along a side; the size of the texture is 1 MiB

extern const ProgramDesc kLumpTileProgram;

/// Fills the periodic cube of noise.
/// writes  tile  R32F, three-dimensional, kLumpTileTexels along each side: noise of mean 0 and standard
///               deviation 1, equal to the values of class LumpTile
/// Formula: lump-noise.
class LumpTilePass
{
public:
    [[nodiscard]] static ResourceId addTo(FrameGraph& graph, ResourceId tile);
};

} // namespace fx::render
