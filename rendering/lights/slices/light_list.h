/// @file light_list.h
/// The lights of one view, which of them cast shadows through media, and where their planes lie in the atlas.
#pragma once

#include "rendering/frame/view_types.h"
#include "rendering/lights/effect_lights.h"
#include "rendering/lights/slices/slice_fades.h"
#include "rendering/lights/slices/slice_stack.h"
#include "rendering/passes/light_bindings.h"

#include <glm/vec4.hpp>

#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Layout of SliceStack in shaders/lights/light_slices.comp.glsl.
struct SliceStackBlock
{
    glm::vec4 origin;
    glm::vec4 right, up, along;
    glm::vec4 tiles;
};
static_assert(sizeof(SliceStackBlock) == 5 * 16);

constexpr uint64_t kSliceTexelBytes = 8; ///< depth and its slope towards the next plane, 32 bits each
constexpr int kSliceTileColumns = 8;     ///< tiles in a row of the planes of a stack
constexpr size_t kFinerPlanes =
    kMaxLightEntries - 2;      ///< first entry with finer planes of the sun near the eye
constexpr size_t kSkyAxes = 6; ///< of an icosahedron: both ends of each are sampled, with equal weights
static_assert(1 + kMaxEffectLights + kMaxHostLights + kSkyAxes <= kFinerPlanes);

/// [1] sine of the elevation of all axes but the first, which is vertical.
constexpr float kSkyAxisElevation = 0.4472135955f; // 1 / sqrt(5)

enum class LightKind : uint8_t
{
    Sun,
    Host,   ///< ViewSettings::hostLights
    Effect, ///< of effects in the snapshot
    Sky,    ///< sky and ground, looked up along axes
};

/// Origin of a light of the list.
struct LightOrigin
{
    LightKind kind = LightKind::Sun;
    uint32_t index = 0; ///< of ViewSettings::hostLights, or of the effects' lights, brightest first
};

/// Cost of the planes of a light.
struct LightCost
{
    LightOrigin origin;
    uint32_t stacks = 0; ///< 0: it has no planes, and media cast no shadow in it
    uint32_t planes = 0; ///< of all stacks
    uint64_t texels = 0; ///< of all planes
    uint64_t rays = 0;   ///< along which media are integrated when the planes are filled
};

/// Inputs of the light list of a frame.
struct LightListInputs
{
    const ViewSettings* settings;
    glm::dvec3 eye;                       ///< [m] world
    std::span<const EffectLight> effects; ///< brightest first
    std::span<const MediumCaster> casters;
    bool resetsHistory = false; ///< planes do not fade from those of the last frame
};

/// Lights of a frame in the order in which they get planes: the sun, then the others by the light that
/// arrives at the casters, then the axes of the sky. Planes of other sides than in the last frame fade in.
/// Threads: one at a time. Equal inputs give equal bits, after equal inputs.
class LightList
{
public:
    explicit LightList(std::pmr::memory_resource* memory);

    /// Begins a frame: planes whose sides change fade.
    void build(const LightListInputs& in);
    /// Builds the list of the same frame again from other inputs, reverting the last build().
    void rebuild(const LightListInputs& in);
    /// Sets the shadow map by which opaque surfaces shade media. @param shift [m] eye minus the origin of the
    /// map's coordinates @return whether the block has changed
    bool setSunShadow(const HostShadowMap& map, const glm::dvec3& shift);

    const LightListBlock& block() const { return block_; }
    /// The sun, points, axes of the sky; without finer planes of the sun.
    std::span<const SliceLightBlock> lights() const
    {
        return std::span(block_.lights).first(size_t(block_.counts.x + block_.counts.y));
    }
    /// Origins of the first block().counts.x entries.
    std::span<const LightOrigin> origins() const { return origins_; }
    std::span<const SliceStackBlock> stackBlocks() const { return stackBlocks_; }
    std::span<const SliceStack> stacks() const { return stacks_; }
    /// Number of costs: one for each of the first block().counts.x lights, then one for the sky if it has
    /// planes.
    size_t costCount() const;
    LightCost costOf(size_t light) const;
    uint64_t placesRevision() const
    {
        return placesRevision_;
    }                                                ///< differs where planes lie elsewhere in the world
    int atlasWidth() const { return atlasWidth_; }   ///< [texel] size; 0: no medium casts a shadow
    int atlasHeight() const { return atlasHeight_; } ///< [texel]
    int mostTexels() const { return mostTexels_; }   ///< [texel] side of the largest plane

private:
    void list(const LightListInputs& in);
    void addSun(const LightListInputs& in);
    void addPoints(const LightListInputs& in);
    void addSky(const LightListInputs& in);
    void addCascades(const LightListInputs& in);
    template <class Fit>
    float addStacks(const Fit& fit, bool isSnapped, size_t entry);
    void addStack(const SliceStack& stack, size_t entry);
    void placeTiles();

    void add(const SliceLightBlock& light);

    LightListBlock block_{};
    size_t count_ = 0;
    std::pmr::vector<LightOrigin> origins_;
    SliceFades fades_;
    SliceFades fadesBefore_; ///< of the frame before
    float sunTexel_ =
        0.0f; ///< [m] side of the sun's texels, between the one before and that now; 0: no planes
    std::pmr::vector<SliceStack> stacks_;
    std::pmr::vector<size_t> stackLights_; ///< the light of each stack
    std::pmr::vector<SliceStackBlock> stackBlocks_;
    uint64_t placesRevision_ = 0;
    int atlasWidth_ = 0, atlasHeight_ = 0;
    int mostTexels_ = 0;
};

} // namespace fx::render
