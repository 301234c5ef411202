/// @file field_textures.h
/// The textures that contain the bricks of all fields of a view.
#pragma once

#include "rendering/frame_graph/frame_graph.h"

#include <array>

namespace fx::render {

/// Three-dimensional textures of kBrickColumns x kBrickColumns bricks a layer.
struct FieldTextures
{
    ResourceId medium = {}; ///< RGBA32F rgb emitted light [exposed/m]; a extinction [1/m]
    ResourceId scatter =
        /// RGBA16F mean albedo and mean cosine of the phase function; with layers, FieldLightPass replaces
        /// them by light
        {};
    ResourceId shares = {}; ///< RGBA16F share of each layer in the extinction; invalid without layers
    ResourceId table = {};  ///< R32F table of bricks, see shaders/field/field_blocks.glsl
    /// RGBA16F noise coordinates that balls carry, of each generation; invalid without detail
    std::array<ResourceId, 2> material = {};
    /// R32F change of the extinction by detail; invalid without detail
    ResourceId change = {};
};

constexpr Format kFieldFormats[] = {Format::RGBA32F, Format::RGBA16F, Format::RGBA16F,
                                    Format::RGBA16F, Format::RGBA16F, Format::R32F};

} // namespace fx::render
