/// @file light_bindings.h
/// The lights of a view as resources for draws: a uniform block, and a texture of optical depths.
#pragma once

#include "rendering/frame_graph/frame_graph.h"

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace fx::render {

/// Layout of SliceLight in shaders/shared/light_block.glsl, where each member is explained.
struct SliceLightBlock
{
    glm::vec4 right, up, along;
    glm::vec4 tiles;
    glm::vec4 color;
    glm::vec4 place;
    glm::vec4 cone;
};
static_assert(sizeof(SliceLightBlock) == 7 * 16);

/// Largest number of entries: lights, axes of the sky and finer planes of the sun.
constexpr size_t kMaxLightEntries = 21;

/// Offset of entries for cross-fades. During a cross-fade, entry i + kFadingEntries has the previous planes
/// of light i in the members right, up, along and tiles. The member color.r is the weight [1] of the
/// previous planes; 0: no cross-fade.
constexpr size_t kFadingEntries = kMaxLightEntries;

/// Layout of the block Lights in shaders/shared/light_block.glsl.
struct LightListBlock
{
    glm::ivec4 counts;
    glm::vec4 sky;
    glm::vec4 ground;
    glm::vec4 hostShadow[3];
    glm::vec4 hostShadowEdge;
    SliceLightBlock lights[kMaxLightEntries + kFadingEntries];
};
static_assert(sizeof(LightListBlock) == (7 + (kMaxLightEntries + kFadingEntries) * 7) * 16);

constexpr uint32_t kLightBlockBinding = 1; ///< uniform binding of LightListBlock
constexpr uint32_t kLightSliceUnit = 7;    ///< texture unit of the planes of light slices
constexpr uint32_t kHostShadowUnit = 6;    ///< texture unit of the host's shadow map of the sun

struct LightBindings
{
    ResourceId lights = {}; ///< buffer with a LightListBlock; invalid: media are not lit
    ResourceId planes = {}; ///< RG32F optical depths in light slices; invalid: media cast no shadow
    /// Depth texture of the host's shadow map; invalid: surfaces of the host cast no shadow on media.
    ResourceId hostShadow = {};
    std::span<const std::byte> stacks = {}; ///< SliceStackBlocks of the planes
    int mostTexels = 0;                     ///< [texel] side of the largest plane
    /// A number that changes when the planes are filled again.
    uint64_t filled = 0;

    void read(FrameGraph::Builder& builder) const
    {
        if (lights.valid())
            builder.read(lights);
        if (planes.valid())
            builder.read(planes);
        if (hostShadow.valid())
            builder.read(hostShadow);
    }
    BufferBinding bufferBinding() const
    {
        return {kLightBlockBinding, lights, 0, sizeof(LightListBlock), true};
    }
    TextureBinding textureBinding() const { return {kLightSliceUnit, planes, Sampling::Linear}; }
    TextureBinding hostShadowBinding() const { return {kHostShadowUnit, hostShadow}; }
};

} // namespace fx::render
