/// @file field_textures.h
/// The textures that contain the bricks of all fields of a view.
#pragma once

#include "rendering/frame_graph/frame_graph.h"

#include <array>

namespace fx::render {

/// Three-dimensional textures with kBrickColumns x kBrickColumns bricks along x and y.
struct FieldTextures
{
    ResourceId medium = {}; ///< RGBA32F rgb: emitted light [exposed/m]; alpha: extinction [1/m]
    /// RGBA16F rgb: mean albedo; alpha: mean cosine of the phase function. With layers or detail,
    /// FieldLightPass overwrites the texture with light.
    ResourceId scatter = {};
    /// RGBA16F extinction of the layers over the field's largest extinction; invalid without layers.
    ResourceId shares = {};
    ResourceId table = {}; ///< R32F table of bricks, see shaders/field/field_blocks.glsl
    /// RGBA16F rgb: offset of the noise coordinates of each generation, weighted by extinction; invalid
    /// without detail
    std::array<ResourceId, 2> material = {};
    /// R32F change of the extinction by detail, or between volumes and their balls, over the field's largest
    /// extinction; invalid without detail and volumes
    ResourceId change = {};
};

constexpr Format kFieldFormats[] = {Format::RGBA32F, Format::RGBA16F, Format::RGBA16F,
                                    Format::RGBA16F, Format::RGBA16F, Format::R32F};

} // namespace fx::render
