/// @file light_slices_pass.h
/// The pass that fills the planes of all lights of a view.
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

extern const ProgramDesc kLightSlicesProgram;

/// Integrates the media between each light and each texel of its planes.
///
/// reads   casters  buffer of two vec4 per caster: center and radius; cross section
///         stacks   buffer of SliceStackBlock
/// writes  atlas    RG32F: optical depth up to the plane, and from the plane to the next plane
/// Each texel is written by one invocation, which adds casters in the order of the list. Therefore equal
/// inputs give bit-identical results. Many casters are added by several passes, one after the other.
class LightSlicesPass
{
public:
    struct Inputs
    {
        ResourceId casters;
        ResourceId stacks;
        ResourceId atlas;
        uint32_t casterCount;
        uint32_t stackCount;
        int mostTexels; ///< [texel] side of the largest plane
        int mostPlanes; ///< of a stack
    };
    struct Outputs
    {
        ResourceId atlas;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
