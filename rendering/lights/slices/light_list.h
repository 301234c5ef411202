/// @file light_list.h
/// The lights of one view, which of them cast shadows through media, and where their planes lie in the atlas.
#pragma once

#include "rendering/frame/view_types.h"
#include "rendering/lights/effect_lights.h"
#include "rendering/lights/slices/slice_stack.h"

#include <glm/vec4.hpp>

#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Layout of SliceLight in shaders/shared/light_slices.glsl, where each member is explained.
struct SliceLightBlock
{
    glm::vec4 right, up, along;
    glm::vec4 tiles;
    glm::vec4 color;
    glm::vec4 place;
    glm::vec4 cone;
};
static_assert(sizeof(SliceLightBlock) == 7 * 16);

/// Layout of SliceStack in shaders/lights/light_slices.comp.glsl.
struct SliceStackBlock
{
    glm::vec4 origin;
    glm::vec4 right, up, along;
    glm::vec4 tiles;
};
static_assert(sizeof(SliceStackBlock) == 5 * 16);

/// Head of the buffer of lights, before its SliceLightBlocks.
struct LightListHead
{
    glm::ivec4 counts; ///< x lights; y axes of the sky after them; z points of a ray through a ball; w unused
    glm::vec4 sky;     ///< rgb exposed luminance from above; w 1: light that is scattered again counts
    glm::vec4 ground;  ///< rgb exposed luminance from below
};
static_assert(sizeof(LightListHead) == 3 * 16);

constexpr int kSliceTileColumns = 8; ///< planes of a stack lie in rows of so many tiles
constexpr size_t kSkyAxes = 6;       ///< of an icosahedron: both ends of each are sampled, with equal weights
constexpr size_t kMostLights = 1 + kMostEffectLights + kMostHostLights;

/// [1] sine of the elevation of all axes but the first, which is vertical.
constexpr float kSkyAxisElevation = 0.4472135955f; // 1 / sqrt(5)

/// What the lights of a frame are made from.
struct LightListInputs
{
    const ViewSettings* settings;
    glm::dvec3 eye;                       ///< [m] world
    std::span<const EffectLight> effects; ///< brightest first
    std::span<const MediumCaster> casters;
};

/// Lights of a frame in the order in which they get planes: the sun, then the others by the light that
/// arrives at the casters, then the axes of the sky. Threads: one at a time. Equal inputs give equal bits.
class LightList
{
public:
    explicit LightList(std::pmr::memory_resource* memory);

    /// Of everything but the casters that decides which planes there are and what they hold.
    static uint64_t planesKey(const LightListInputs& in);

    /// @param keepsPlanes the planes stay where they were in the world when build() was called last; the
    /// casters and planesKey() are those of then
    void build(const LightListInputs& in, bool keepsPlanes = false);

    const LightListHead& head() const { return head_; }
    std::span<const SliceLightBlock> lights() const { return lights_; } ///< those of the sky at the end
    std::span<const SliceStackBlock> stackBlocks() const { return stackBlocks_; }
    std::span<const SliceStack> stacks() const { return stacks_; }
    int atlasWidth() const { return atlasWidth_; }   ///< [texel] 0: nothing casts a shadow
    int atlasHeight() const { return atlasHeight_; } ///< [texel]
    int mostTexels() const { return mostTexels_; }   ///< [texel] side of the largest plane

private:
    void addSun(const LightListInputs& in);
    void addPoints(const LightListInputs& in);
    void addSky(const LightListInputs& in);
    bool takeKept(const glm::dvec3& eye, SliceStack& outStack) const;
    glm::dvec3 originInWorld(const glm::dvec3& eye, const SliceStack& stack) const;
    void addStack(const SliceStack& stack, const glm::dvec3& eye, SliceLightBlock& ioLight);
    void placeTiles();

    LightListHead head_{};
    std::pmr::vector<SliceLightBlock> lights_;
    std::pmr::vector<SliceStack> stacks_;
    std::pmr::vector<size_t> stackLights_; ///< the light of each stack
    std::pmr::vector<SliceStackBlock> stackBlocks_;
    std::pmr::vector<glm::dvec3> origins_;     ///< [m] world, of stacks_
    std::pmr::vector<SliceStack> kept_;        ///< of the last call, in place of fitting new ones
    std::pmr::vector<glm::dvec3> keptOrigins_; ///< [m] world, of kept_
    int atlasWidth_ = 0, atlasHeight_ = 0;
    int mostTexels_ = 0;
};

} // namespace fx::render
