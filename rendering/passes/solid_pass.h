/// @file solid_pass.h
#pragma once

#include "rendering/passes/media_pass.h"

namespace fx::render {

/// Draws opaque particles, with depth test, before any media are drawn. The media pass blends media over the
/// opaque particles. Rays of the media pass end at the particles. The host's depth is read, but not written.
///
/// reads   distance  [m] along the ray to the host's opaque geometry
/// writes  under     media or layer targets of MediaPass: exposed radiance and opacity 1 of particles, else 0
///         distance  [m] a new texture: distance to the nearest surface of host and particles
/// No pass is added without sources. The pass keeps no state.
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
        MediaPass::Outputs under; ///< media or layer targets; invalid without sources
        ResourceId distance;      ///< distance to the nearest surface; Inputs::distance without sources
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
