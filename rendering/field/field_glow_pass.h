/// @file field_glow_pass.h
/// The passes that propagate emitted light through media, such as the light of fire through smoke.
#pragma once

#include "rendering/field/field_blocks.h"
#include "rendering/field/field_textures.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>

namespace fx::render {

/// Textures of the grids of FieldGlowPlan. The grids are stacked along z.
struct GlowTextures
{
    /// RGBA32F rgb: sum of emitted light and light that is scattered once; alpha: extinction.
    ResourceId cells = {};
    /// RGBA16F rgb: extinction times albedo; alpha: mean cosine of the phase function.
    ResourceId scatter = {};
    ResourceId rays = {};  ///< RGBA16F radiance; one block per direction, side by side along x and y
    ResourceId first = {}; ///< RGBA16F mean radiance of emitted light
    ResourceId light = {}; ///< RGBA16F logarithm of the mean radiance of emitted and scattered light
};

/// Computes the mean radiance in each cell of a grid. The radiance includes the light that media emit, and
/// its multiple scattering.
///
/// reads   fieldTexels    texture written by FieldTexelPass
///         grids          buffer of FieldGlowBlock
///         field          textures that FieldFillPass has filled, not yet lit
///         lumpTile       texture written by LumpTilePass
/// writes  all textures of GlowTextures; `light` is the result
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
        uint32_t fieldCount;  ///< > 0
        uint32_t gridCount;   ///< > 0
        glm::ivec3 extent{0}; ///< glowExtent() of the grids; addTo() requires cubes of kGlowCells
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
