/// @file media_pass.h
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/impostor_pass.h"
#include "rendering/passes/particle_batch.h"

#include <array>

namespace fx::render {

/// The program of one permutation: form of the billboard, procedural detail, light sorted by layer, targets
/// smaller than the picture.
const ProgramDesc& mediaProgram(BillboardForm form, bool detail, bool layers, bool isSmall);
constexpr size_t kMediaPrograms = 3 * 2 * 2 * 2;
const ProgramDesc& mediaProgramAt(size_t index);

/// Draws all blobs of fire, smoke and dust as balls of medium and all particles that do not hide, in the
/// order of `runs`, so that layers and kinds are composed by depth. Formula of blobs: kernel-optical-depth,
/// or the form that is asked for.
///
/// reads   blobs     buffer of BlobInstance sorted by falling distance
///         batches   rows, orders, textures
///         distance  [m] along the ray to opaque geometry
/// writes  media     RGBA32F exposed radiance, premultiplied "over"; or, with layers, the same light in six
///         targets
/// Adds nothing when there is no run. Keeps no state.
class MediaPass
{
public:
    struct Inputs
    {
        ResourceId blobs;                       ///< invalid when there is none
        std::span<const ParticleBatch> batches; ///< must stay until the graph has executed, like `runs`
        std::span<const MediaRun> runs;
        ResourceId distance;
        int width, height;
        ViewBlock view;
        BillboardForm form;
        bool detail;
        bool layers;
        bool isSmall = false;        ///< of a layer grid whose texels are larger than pixels
        ImpostorDraw impostors = {}; ///< effects that are drawn as pictures; not with layers
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
    /// @param under what is drawn over; invalid members: nothing
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in, const Outputs& under);
};

/// The target number `target` of the media pass.
TextureDesc mediaTargetDesc(bool layers, size_t target, int width, int height);

} // namespace fx::render
