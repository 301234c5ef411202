/// @file field_slices_pass.h
/// The pass that adds the change of extinction by the detail of fields to the light slices.
#pragma once

#include "rendering/field/field_textures.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>

namespace fx::render {

extern const ProgramDesc kFieldSlicesProgram;

/// Adds the change of extinction by the detail of fields to light slices.
/// reads   fieldTexels    of FieldTexelPass
///         table          table of bricks, of FieldFillPass
///         change         change of extinction by detail, see FieldTextures
///         stacks         buffer of SliceStackBlock
/// writes  planes         light slices of all lights, which have just been filled with smooth balls
/// Where a field has no bricks because it is not visible, balls stay smooth.
class FieldSlicesPass
{
public:
    struct Inputs
    {
        ResourceId fieldTexels, table;
        ResourceId change;
        ResourceId stacks;
        LightBindings lights; ///< lights, which must have planes
        uint32_t fieldCount;
        uint32_t stackCount;
    };
    [[nodiscard]] static LightBindings addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
