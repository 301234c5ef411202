/// @file field_slices_pass.h
/// The pass that corrects light slices for the detail of fields, and for volumes.
#pragma once

#include "rendering/field/field_textures.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>

namespace fx::render {

extern const ProgramDesc kFieldSlicesProgram;

/// Detail of fields changes their extinction; volumes have another one than the balls that stand for them.
/// This pass adds the change to the light slices.
/// reads   fieldTexels    texture written by FieldTexelPass
///         table          table of bricks, written by FieldFillPass
///         change         change of extinction by detail, see FieldTextures
///         stacks         buffer of SliceStackBlock
/// writes  planes         light slices of all lights; they already contain the balls without detail
/// Fields have bricks only where they may be visible. Elsewhere the slices contain the balls without detail.
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
