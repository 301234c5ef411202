/// @file media_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/view_block.h"

#include <array>

namespace fx::render {

/// The program of one permutation: form of the billboard, procedural detail, light sorted by layer, targets
/// smaller than the picture.
const ProgramDesc& mediaProgram(BillboardForm form, bool detail, bool layers, bool isSmall);
constexpr size_t kMediaPrograms = 3 * 2 * 2 * 2;
const ProgramDesc& mediaProgramAt(size_t index);

/// Draws all blobs of fire, smoke and dust as balls of medium, farthest first, in one order, so that the
/// three layers are composed by depth and not by kind. Formula: kernel-optical-depth, or the form that is
/// asked for.
///
/// reads   blobs     buffer of BlobInstance sorted by falling distance
///         distance  [m] along the ray to opaque geometry
/// writes  media     RGBA32F exposed radiance, premultiplied "over"; or, with layers, the same light in six
/// targets Adds nothing when there is no blob. Keeps no state.
class MediaPass
{
public:
    struct Inputs
    {
        ResourceId blobs;
        ResourceId distance;
        uint32_t count;
        int width, height;
        ViewBlock view;
        BillboardForm form;
        bool detail;
        bool layers;
        bool isSmall = false; ///< of a layer grid whose texels are larger than pixels
    };
    /// What `layers` asks for, in the order of media.frag.glsl.
    enum LayerTarget : size_t
    {
        Fire,
        Smoke,
        Dust,
        Coverage,
        DepthMoment,
        OpticalDepth,
        LayerTargets
    };
    struct Outputs
    {
        ResourceId media;                            ///< invalid with layers, or when nothing is drawn
        std::array<ResourceId, LayerTargets> layers; ///< invalid without layers
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
