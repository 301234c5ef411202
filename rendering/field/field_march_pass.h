/// @file field_march_pass.h
/// The pass that marches through all fields of a view, summed with balls and cards outside of fields.
#pragma once

#include "rendering/field/field_textures.h"
#include "rendering/passes/media_pass.h"

namespace fx::render {

constexpr size_t kFieldMarchPrograms = 2 * 2 * 2;
/// The program with or without layers, detail of fields, and balls and cards outside of fields.
const ProgramDesc& fieldMarchProgram(bool layers, bool detail, bool loose);
const ProgramDesc& fieldMarchProgramAt(size_t index);

/// Balls and cards that no field holds, in lists of tiles of 16 x 16 texels, as the composition `slabs` makes
/// them.
struct LooseMedia
{
    /// Non-empty tiles, with or without fields: arguments of a draw; invalid without balls and cards outside
    /// of fields.
    ResourceId tiles;
    ResourceId lists; ///< of balls
    ResourceId balls; ///< as texels; invalid: none
    CardLists cards;
    int slabs = 16; ///< that balls and cards are at least divided into, along a ray
};

/// Marches front to back. Each step is a slab across the ray, in which fields, balls and cards are summed up,
/// so that no order is seen. A ray ends at what is opaque, and without layers where less than 1e-4 of the
/// light passes. Formula: slab-light.
///
/// reads   textures         that FieldFillPass and FieldLightPass have written; fieldTexels, tiles
///         distance         [m] along the ray to opaque geometry
///         loose            and lights, for its balls
/// writes  media            as the media pass, drawn over `under` Parts of the window without fields, balls
/// and cards cost nothing. Keeps no state.
class FieldMarchPass
{
public:
    struct Inputs
    {
        const MediaPass::Inputs* media;
        FieldTextures textures;
        ResourceId fieldTexels;   ///< of FieldTexelPass
        ResourceId tiles;         ///< buffer of FieldTexels::tiles()
        ResourceId lumpTile = {}; ///< of LumpTilePass; invalid: no field has detail
        LooseMedia loose = {};
    };
    /// Of SlabTilePass: each step of a ray reads all of them.
    static constexpr uint32_t kMaxLooseOfTile = 256;
    [[nodiscard]] static MediaPass::Outputs addTo(FrameGraph& graph, const Inputs& in,
                                                  const MediaPass::Outputs& under);
};

} // namespace fx::render
