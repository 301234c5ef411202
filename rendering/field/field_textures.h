/// @file field_textures.h
/// The textures in which the bricks of all fields of a view lie.
#pragma once

#include "rendering/frame_graph/frame_graph.h"

#include <array>

namespace fx::render {

/// Three-dimensional textures of kBrickColumns x kBrickColumns bricks a layer.
struct FieldTextures
{
    ResourceId medium = {}; ///< RGBA32F rgb emitted light [exposed/m]; a extinction [1/m]
    ResourceId scatter =
        {}; ///< RGBA16F mean albedo and mean cosine of the phase function; with layers then light
    ResourceId shares = {}; ///< RGBA16F of the layers in the extinction; invalid without layers
    ResourceId table = {};  ///< R32F bricks, see shaders/field/field_blocks.glsl
    std::array<ResourceId, 2> material = {}; ///< RGBA16F what media carry; invalid without detail
    ResourceId change = {};                  ///< R32F change of the extinction by detail; likewise
};

constexpr Format kFieldFormats[] = {Format::RGBA32F, Format::RGBA16F, Format::RGBA16F,
                                    Format::RGBA16F, Format::RGBA16F, Format::R32F};

} // namespace fx::render
