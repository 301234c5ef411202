/// @file field_glow_pass.h
/// The passes that propagate emitted light through media: fire lights smoke from inside.
#pragma once

#include "rendering/field/field_blocks.h"
#include "rendering/field/field_textures.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>

namespace fx::render {

/// Textures of the grids of FieldGlowPlan. The grids are stacked along z.
struct GlowTextures
{
    /// RGBA32F rgb emitted light, to which light that is scattered once is added; a extinction.
    ResourceId cells = {};
    ResourceId scatter = {}; ///< RGBA16F rgb extinction times albedo; a mean cosine of the phase function
    ResourceId rays = {};    ///< RGBA16F radiance; one block per direction, side by side along x and y
    ResourceId first = {};   ///< RGBA16F mean radiance of emitted light
    ResourceId light = {};   ///< RGBA16F logarithm of the mean radiance of emitted and scattered light
};

/// Computes the mean radiance in each cell of a grid of the light that media emit and scatter any number of
/// times.
///
/// reads   fieldTexels    of FieldTexelPass
///         grids          buffer of FieldGlowBlock
///         field          filled textures, not yet lit
///         lumpTile       of LumpTilePass
/// writes  all of GlowTextures; `light` is the result
/// Formula: field-glow.
class FieldGlowPass
{
public:
    struct Inputs
    {
        ResourceId fieldTexels;
        FieldTextures field;
        ResourceId lumpTile; ///< used only if a field has detail
        bool detail;         ///< true: a field has detail
        ResourceId grids;
        GlowTextures glow;
        uint32_t fieldCount; ///< > 0
        uint32_t gridCount;  ///< > 0
        /// Number of cells along a side of a grid, a multiple of 8; addTo() requires kGlowCells.
        int cells = kGlowCells;
    };
    struct Outputs
    {
        GlowTextures glow;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
    /// Adds only the pass that writes `cells` and `scatter`: emission, extinction and scattering of each
    /// cell.
    [[nodiscard]] static GlowTextures addSourcesTo(FrameGraph& graph, const Inputs& in);
};

const ProgramDesc& glowSourceProgram(bool detail);
extern const ProgramDesc kGlowSourceAgainProgram;
const ProgramDesc& glowRaysProgram(bool again);
const ProgramDesc& glowSumProgram(bool again);

} // namespace fx::render
