/// @file solid_pass.h
#pragma once

#include "rendering/passes/media_pass.h"

namespace fx::render {

/// Draws opaque particles with depth test before any media. The media pass blends over them and ends its rays
/// at them. The host's depth is read, not written.
///
/// reads   distance  [m] along the ray to the host's opaque geometry writes  media, or the layer targets, as
///         the media pass does: exposed radiance, opacity 1 or nothing distance [m] a new texture, to the
///         nearest of host and particles
/// Adds nothing without sources. Keeps no state.
class SolidPass
{
public:
    struct Inputs
    /// with solids; must stay until the graph has executed
    {
        std::span<const MediaSource* const> sources;
        ResourceId distance;
        int width, height;
        ViewBlock view;
        bool layers;
        LightBindings lights{};
    };
    struct Outputs
    /// invalid when nothing is drawn
    {
        MediaPass::Outputs under;
        ResourceId distance; ///< the one given when nothing is drawn
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
