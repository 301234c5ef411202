/// @file solid_pass.h
#pragma once

#include "rendering/passes/media_pass.h"

namespace fx::render {

/// Draws opaque particles, with depth test, before any media are drawn. The media pass blends over them, and
/// its rays end at them. The host's depth is read, not written.
///
/// reads   distance  [m] along the ray to the host's opaque geometry
/// writes  under     media or layer targets, as written by MediaPass: exposed radiance with opacity 1, or 0
///         distance  [m] a new texture: distance to the nearest surface of host and particles
/// Adds nothing without sources. Keeps no state.
class SolidPass
{
public:
    struct Inputs
    {
        /// Sources of opaque particles; must stay valid until the graph has executed.
        std::span<const MediaSource* const> sources;
        ResourceId distance;
        int width, height;
        ViewBlock view;
        bool layers;
        LightBindings lights{};
    };
    struct Outputs
    {
        MediaPass::Outputs under; ///< media or layer targets; invalid if nothing is drawn
        ResourceId distance;      ///< distance to the nearest surface; Inputs::distance if nothing is drawn
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
