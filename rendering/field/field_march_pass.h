/// @file field_march_pass.h
/// The pass that marches rays through all fields of a view, and through balls and cards (flat particles)
/// outside of fields.
#pragma once

#include "rendering/field/field_textures.h"
#include "rendering/passes/media_pass.h"

namespace fx::render {

constexpr size_t kFieldMarchPrograms = 2 * 2 * 2;
/// Returns the variant of the program with or without layers, detail of fields, and loose media (balls and
/// cards outside of fields).
const ProgramDesc& fieldMarchProgram(bool layers, bool detail, bool loose);
const ProgramDesc& fieldMarchProgramAt(size_t index);

/// Balls and cards outside of fields, listed per tile of 16 x 16 texels as in the composition `slabs`.
struct LooseMedia
{
    /// Buffer with draw arguments for the tiles that contain fields or loose media; invalid without loose
    /// media.
    ResourceId tiles;
    ResourceId lists; ///< buffer of the indices of balls, see SlabTilePass
    ResourceId balls; ///< texture written by SlabBallPass; invalid: no balls
    CardLists cards;
    int slabs = 16; ///< least number of slabs along a ray for balls and cards
};

/// Marches rays front to back. Each step is a slab of the ray in which fields, balls and cards are summed, so
/// that the result does not depend on their order. A ray ends at opaque geometry and, without layers, where
/// the transmittance is below 1e-4. Formula: slab-light.
///
/// reads   textures         results of FieldFillPass and FieldLightPass; fieldTexels, tiles
///         distance         [m] along the ray to opaque geometry
///         loose            balls and cards outside of fields
/// writes  media            targets of MediaPass, drawn over `under`
/// No work is done for parts of the window without fields, balls and cards. The pass keeps no state between
/// frames.
class FieldMarchPass
{
public:
    struct Inputs
    {
        const MediaPass::Inputs* media;
        FieldTextures textures;
        ResourceId fieldTexels;   ///< texture of FieldTexelPass
        ResourceId tiles;         ///< buffer of FieldTexels::tiles()
        ResourceId lumpTile = {}; ///< texture written by LumpTilePass; invalid: no field has detail
        LooseMedia loose = {};
    };
    /// Value of SlabTilePass::Inputs::maxOfTile. The value is small, because each step of a ray reads the
    /// whole list of a tile.
    static constexpr uint32_t kMaxLooseOfTile = 256;
    [[nodiscard]] static MediaPass::Outputs addTo(FrameGraph& graph, const Inputs& in,
                                                  const MediaPass::Outputs& under);
};

} // namespace fx::render
