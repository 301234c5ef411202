/// @file media_pass.h
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/media_source.h"

#include <array>

namespace fx::render {

/// Draws media and transparent sprites and ribbons in the order of `batches`, so that layers and techniques
/// are composited by depth.
///
/// reads   the buffers of the sources
///         distance  [m] along the ray to opaque geometry
/// writes  media     RGBA32F exposed radiance, premultiplied; with layers, instead the six layer targets
/// No pass is added without batches. The pass keeps no state.
class MediaPass
{
public:
    struct Inputs
    {
        /// Batches in the order of drawing. Batches and their sources must stay valid until the graph has
        /// executed.
        std::span<const DrawBatch> batches;
        ResourceId distance;
        int width, height;
        ViewBlock view;
        bool layers;
        bool isSmall = false; ///< true: the targets have fewer texels than the picture has pixels
        LightBindings lights{};
    };
    /// Indices of the outputs with `layers`, in the order of media.frag.glsl.
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
        ResourceId media;                            ///< invalid with `layers`, or without batches
        std::array<ResourceId, LayerTargets> layers; ///< invalid without layers
    };
    /// Adds the pass.
    /// @param under targets that are drawn over; if a member is invalid, a new target is created
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in, const Outputs& under);
};

/// Returns the description of a target of the media pass.
TextureDesc mediaTargetDesc(bool layers, size_t target, int width, int height);

/// The targets of a pass that draws media over existing targets. The execute function of a pass captures this
/// object by value.
class MediaTargets
{
public:
    /// Declares that the pass writes the targets of `under`. Creates a new target for each invalid target.
    MediaTargets(FrameGraph::Builder& builder, const MediaPass::Inputs& in, const MediaPass::Outputs& under);

    /// Clears the targets that the pass has created. Must be called before drawing.
    void clear(Backend& backend) const;
    std::span<const ResourceId> all() const { return {targets_.data(), layers_ ? targets_.size() : 1}; }
    MediaPass::Outputs outputs() const;

private:
    std::array<ResourceId, MediaPass::LayerTargets> targets_;
    bool layers_;
    bool isFirst_;
};

} // namespace fx::render
