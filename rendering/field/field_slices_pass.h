/// @file field_slices_pass.h
/// The pass that adds the effect of detail on fields to the light slices.
#pragma once

#include "rendering/field/field_textures.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>

namespace fx::render {

extern const ProgramDesc kFieldSlicesProgram;

/// reads   fieldTexels    of FieldTexelPass
///         table          of FieldFillPass
///         change         of extinction by detail
///         stacks         buffer of SliceStackBlock
/// writes  planes         of all lights, which have just been filled with smooth balls. Where a field has no
/// bricks, because
///                        the view does not see it, balls stay smooth
class FieldSlicesPass
{
public:
    struct Inputs
    {
        ResourceId fieldTexels, table;
        ResourceId change;
        ResourceId stacks;
        LightBindings lights; ///< with planes
        uint32_t fieldCount;
        uint32_t stackCount;
    };
    [[nodiscard]] static LightBindings addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
