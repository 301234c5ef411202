/// @file light_list.h
/// The lights of one view, and the positions of their planes in the atlas. Planes store the shadows of media
/// in a light.
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

/// [byte] Size of a texel: two optical depths of 32 bits, up to the plane and from the plane to the next
/// plane.
constexpr uint64_t kSliceTexelBytes = 8;
constexpr int kSliceTileColumns = 8; ///< number of tiles in a row of the atlas; a tile contains a plane
/// index of the first entry for finer planes of the sun near the eye
constexpr size_t kFinerPlanes = kMaxLightEntries - 2;
/// number of axes of an icosahedron; both directions of each axis are sampled, with equal weights
constexpr size_t kSkyAxes = 6;
static_assert(1 + kMaxEffectLights + kMaxHostLights + kSkyAxes <= kFinerPlanes);

/// [1] Sine of the elevation of axes 1 to 5; axis 0 is vertical.
constexpr float kSkyAxisElevation = 0.4472135955f; // 1 / sqrt(5)

enum class LightKind : uint8_t
{
    Sun,
    Host,   ///< a light of ViewSettings::hostLights
    Effect, ///< a light of an effect in the snapshot
    Sky,    ///< light of sky and ground, sampled along axes
};

/// The source of a light in the list.
struct LightOrigin
{
    LightKind kind = LightKind::Sun;
    uint32_t index = 0; ///< index in ViewSettings::hostLights or in LightListInputs::effects
};

/// Cost of the planes of a light.
struct LightCost
{
    LightOrigin origin;
    uint32_t stacks = 0; ///< number of stacks; 0: no planes, so that media cast no shadows in this light
    uint32_t planes = 0; ///< number of planes of all stacks
    uint64_t texels = 0; ///< number of texels of all planes
    uint64_t rays = 0;   ///< number of rays of all stacks; media are integrated along each ray
};

/// Inputs of the light list of a frame.
struct LightListInputs
{
    const ViewSettings* settings;
    glm::dvec3 eye;                       ///< [m] world
    std::span<const EffectLight> effects; ///< lights of the effects, brightest first
    std::span<const MediumCaster> casters;
    bool resetsHistory = false; ///< true: planes do not cross-fade from the planes of the last frame
    /// True: these are the inputs of the last frame for another eye, and cross-fades do not advance.
    bool isOtherEye = false;
};

/// The lights of a frame, in the order in which they get planes. The sun comes first, then point lights by
/// their illuminance at the casters, then the axes of the sky. If texel side or spacing of planes differ
/// from the last frame, the new planes fade in. Threads: one at a time. Equal sequences of inputs give
/// bit-identical results.
class LightList
{
public:
    explicit LightList(std::pmr::memory_resource* memory);

    /// Builds the list of the next frame, and advances cross-fades of planes.
    void build(const LightListInputs& in);
    /// Discards the result of the last build(), and builds the list of the frame again from other inputs.
    void rebuild(const LightListInputs& in);
    /// Sets the shadow map for shadows of opaque surfaces on media.
    /// @param shift [m] eye minus the origin of the map's coordinates
    /// @return true if block() has changed
    bool setSunShadow(const HostShadowMap& map, const glm::dvec3& shift);

    const LightListBlock& block() const { return block_; }
    /// The sun, point lights and axes of the sky, without the entries of finer planes of the sun.
    std::span<const SliceLightBlock> lights() const
    {
        return std::span(block_.lights).first(size_t(block_.counts.x + block_.counts.y));
    }
    /// Sources of the first block().counts.x entries.
    std::span<const LightOrigin> origins() const { return origins_; }
    std::span<const SliceStackBlock> stackBlocks() const { return stackBlocks_; }
    std::span<const SliceStack> stacks() const { return stacks_; }
    /// Number of lights that costOf() accepts: the first block().counts.x lights, and one more light for the
    /// sky if the sky has planes.
    size_t costCount() const;
    LightCost costOf(size_t light) const;
    /// A number that changes when the positions of the planes in the world change.
    uint64_t placesRevision() const { return placesRevision_; }
    /// [texel] Width of the atlas; 0: no medium casts a shadow.
    int atlasWidth() const { return atlasWidth_; }
    int atlasHeight() const { return atlasHeight_; } ///< [texel]
    int mostTexels() const { return mostTexels_; }   ///< [texel] side of the largest plane
    int mostPlanes() const { return mostPlanes_; }   ///< of a stack

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
    SliceFades fadesBefore_; ///< cross-fades of the previous frame
    float sunTexel_ = 0.0f;  ///< [m] side of the sun's texels, interpolated during a cross-fade; 0: no planes
    std::pmr::vector<SliceStack> stacks_;
    std::pmr::vector<size_t> stackLights_; ///< for each stack: index of its light
    std::pmr::vector<SliceStackBlock> stackBlocks_;
    uint64_t placesRevision_ = 0;
    int atlasWidth_ = 0, atlasHeight_ = 0;
    int mostTexels_ = 0;
    int mostPlanes_ = 0;
};

} // namespace fx::render
