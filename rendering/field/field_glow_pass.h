/// @file field_glow_pass.h
/// The passes that propagate emitted light through media: fire lights smoke from inside.
#pragma once

#include "rendering/field/field_blocks.h"
#include "rendering/field/field_textures.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>

namespace fx::render {

/// Textures of the grids of FieldGlowPlan, one above the other along z.
struct GlowTextures
{
    ResourceId cells = {};   ///< RGBA32F emitted light, later with what is scattered once; extinction
    ResourceId scatter = {}; ///< RGBA16F extinction times albedo; mean cosine of the phase function
    ResourceId rays = {};    ///< RGBA16F radiance, of all directions beside each other
    ResourceId first = {};   ///< RGBA16F mean radiance of emitted light
    ResourceId light = {};   ///< RGBA16F logarithm of the mean radiance of emitted and scattered light
};

/// Mean radiance in each cell of the light of all media of a grid, any number of times scattered.
///
/// reads   fieldTexels    of FieldTexelPass
///         grids          buffer of FieldGlowBlock
///         field          filled textures, not yet lit
///         lumpTile       of LumpTilePass
/// writes  all of GlowTextures; `light` is the result Formula: field-glow.
class FieldGlowPass
{
public:
    struct Inputs
    {
        ResourceId fieldTexels;
        FieldTextures field;
        ResourceId lumpTile; ///< not used without detail
        bool detail;         ///< some field has detail
        ResourceId grids;
        GlowTextures glow;
        uint32_t fieldCount;    ///< > 0
        uint32_t gridCount;     ///< > 0
        int cells = kGlowCells; ///< along a side of a grid, a multiple of 8; others for addSourcesTo() only
    };
    struct Outputs
    {
        GlowTextures glow;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
    /// Only what the cells emit, extinguish and scatter: writes `cells` and `scatter`.
    [[nodiscard]] static GlowTextures addSourcesTo(FrameGraph& graph, const Inputs& in);
};

const ProgramDesc& glowSourceProgram(bool detail);
extern const ProgramDesc kGlowSourceAgainProgram;
const ProgramDesc& glowRaysProgram(bool again);
const ProgramDesc& glowSumProgram(bool again);

} // namespace fx::render
