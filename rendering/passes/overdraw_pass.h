/// @file overdraw_pass.h
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kOverdrawProgram{"overdraw", "blobs/media.vert.glsl", "blobs/overdraw.frag.glsl",
                                              nullptr, "FX_FORM=2 FX_SMALL=0"};
inline constexpr ProgramDesc kOverdrawSmallProgram{
    "overdraw (small)", "blobs/media.vert.glsl", "blobs/overdraw.frag.glsl", nullptr, "FX_FORM=2 FX_SMALL=1"};

/// Counts how many blobs of the form BillboardForm::Kernel contribute to each pixel, for tuning.
///
/// reads   blobs     buffer of BlobInstance
///         distance  [m] along the ray to opaque geometry
/// writes  count     R32F [1] contributing fragments per pixel
/// The pass is added only if statistics require it. The pass keeps no state.
class OverdrawPass
{
public:
    struct Inputs
    {
        ResourceId blobs;
        ResourceId distance;
        uint32_t count;
        int width, height;
        ViewBlock view;
        bool isSmall = false; ///< true: the target has fewer texels than the picture has pixels
    };
    struct Outputs
    {
        ResourceId count;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
