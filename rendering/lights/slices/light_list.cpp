#include "rendering/lights/slices/light_list.h"

#include "foundation/math/bits.h"
#include "foundation/math/hash.h"
#include "rendering/frame/exposure.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kWideScene = 40.0f; ///< [m] side of planes above which what is near gets planes of its own
constexpr double kCascadeGrid = 1.0 / 16.0; ///< of a side: steps in which finer planes follow the eye
constexpr float kCascadeRatio = 0.2f;       ///< of the sides of a finer and the next coarser stack

/// Planes of lights at points and of the axes of the sky have a part of the resolution of the sun's.
SliceResolution partOf(const SliceResolution& sun, int part)
{
    return {sun.texels / part, (sun.planes + part - 1) / part};
}

/// What light arrives from a point at the middle of the casters decides which points cast shadows.
float arriving(const HostLight& light, const glm::dvec3& middle)
{
    const glm::dvec3 d = light.position - middle;
    const float brightness = light.intensity.x + light.intensity.y + light.intensity.z;
    return brightness / float(glm::dot(d, d) + double(light.radius) * double(light.radius) + 1e-6);
}

/// A light at a point that may get planes.
struct Candidate
{
    HostLight light;
    LightOrigin origin;
    float arrival; ///< see arriving()
};

HostLight pointOf(const EffectLight& light)
{
    HostLight point;
    point.position = light.position;
    point.intensity = light.intensity;
    point.radius = light.radius;
    return point;
}

glm::vec4 coneOf(const HostLight& light)
{
    if (light.cosOuter <= -1.0f)
        return {0.0f, 0.0f, 0.0f, 1.0f};
    const float scale = 1.0f / std::max(light.cosInner - light.cosOuter, 1e-4f);
    return {light.axis * scale, -light.cosOuter * scale};
}

/// [cd/m2] of the ground, from below.
glm::vec3 groundLuminance(const Lighting& lighting)
{
    const glm::vec3 sun = lighting.sunIlluminance * (std::max(lighting.sunDirection.y, 0.0f) / kPi);
    return lighting.groundAlbedo * (sun + lighting.skyLuminance);
}

/// Everything that decides what a plane holds, but for the casters.
uint64_t revisionOf(uint64_t revision, const SliceStack& stack, const glm::vec4& tiles)
{
    for (int i = 0; i < 3; ++i) {
        revision = base::hashWord(revision, std::bit_cast<uint64_t>(stack.corner[i]));
        revision = base::hashWord(revision, std::bit_cast<uint32_t>(stack.along[i]));
    }
    for (const float value :
         {stack.texel, stack.spacing, stack.first, stack.begin, tiles.x, tiles.y, tiles.z, tiles.w})
        revision = base::hashWord(revision, std::bit_cast<uint32_t>(value));
    return base::hashWord(revision, uint64_t(stack.mapping));
}

glm::dvec3 middleOf(std::span<const MediumCaster> casters, const glm::dvec3& eye)
{
    glm::dvec3 sum(0.0);
    for (const MediumCaster& caster : casters)
        sum += glm::dvec3(caster.center);
    return casters.empty() ? eye : eye + sum / double(casters.size());
}

/// Lights at points that give light, those that light the casters most first.
struct SortedPoints
{
    std::array<Candidate, kMaxEffectLights + kMaxHostLights> points;
    size_t count = 0;

    void add(const HostLight& light, const LightOrigin& origin, const glm::dvec3& middle)
    {
        const double numbers[] = {light.position.x,  light.position.y,  light.position.z, light.intensity.x,
                                  light.intensity.y, light.intensity.z, light.radius};
        if (!std::ranges::all_of(numbers, [](double x) { return base::isFinite(x); }) ||
            light.intensity == glm::vec3(0.0f))
            return;
        const float arrival = arriving(light, middle);
        size_t at = count++;
        for (; at > 0 && points[at - 1].arrival < arrival; --at)
            points[at] = points[at - 1];
        points[at] = {light, origin, arrival};
    }
};

SortedPoints sortedPoints(const LightListInputs& in)
{
    SortedPoints sorted;
    const glm::dvec3 middle = middleOf(in.casters, in.eye);
    for (size_t i = 0; i < std::min(in.effects.size(), kMaxEffectLights); ++i)
        sorted.add(pointOf(in.effects[i]), {LightKind::Effect, uint32_t(i)}, middle);
    for (size_t i = 0; i < in.settings->hostLights.count; ++i)
        sorted.add(in.settings->hostLights.lights[i], {LightKind::Host, uint32_t(i)}, middle);
    return sorted;
}

} // namespace

LightList::LightList(std::pmr::memory_resource* memory)
    : origins_(memory), fades_(memory), fadesBefore_(memory), stacks_(memory), stackLights_(memory),
      stackBlocks_(memory)
{
    constexpr size_t kMax =
        kMaxLightEntries + kFadingEntries; // so that fading takes no memory when it begins
    stacks_.reserve(kMax);
    stackLights_.reserve(kMax);
    stackBlocks_.reserve(kMax);
}

void LightList::build(const LightListInputs& in)
{
    fadesBefore_ = fades_;
    list(in);
}

void LightList::rebuild(const LightListInputs& in)
{
    fades_ = fadesBefore_;
    list(in);
}

void LightList::list(const LightListInputs& in)
{
    block_ = {}; // without a shadow map until setSunShadow()
    count_ = 0;
    origins_.clear();
    stacks_.clear();
    stackLights_.clear();
    stackBlocks_.clear();
    fades_.begin(in.resetsHistory);
    const Lighting& lighting = in.settings->lighting;
    const float exposure = exposureFromEv100(in.settings->exposureEv100);
    block_.sky = glm::vec4(lighting.skyLuminance * exposure, in.settings->slices.multiple ? 1.0f : 0.0f);
    block_.ground = glm::vec4(groundLuminance(lighting) * exposure, 0.0f);
    addSun(in);
    addPoints(in);
    block_.counts = {int(count_), 0, in.settings->slices.samples, 0};
    addSky(in);
    block_.counts.y = int(count_) - block_.counts.x;
    addCascades(in);
    placeTiles();
}

/// @param light without planes, which the entry may have already
void LightList::add(const SliceLightBlock& light)
{
    SliceLightBlock& entry = block_.lights[count_++];
    entry.color = light.color;
    entry.place = light.place;
    entry.cone = light.cone;
}

bool LightList::setSunShadow(const HostShadowMap& map, const glm::dvec3& shift)
{
    const std::array<glm::vec4, 4> before{block_.hostShadow[0], block_.hostShadow[1], block_.hostShadow[2],
                                          block_.hostShadowEdge};
    for (int row = 0; row < 3; ++row) {
        const glm::vec3 across(map.fromWorld[0][row], map.fromWorld[1][row], map.fromWorld[2][row]);
        const double at = double(map.fromWorld[3][row]) + glm::dot(glm::dvec3(across), shift);
        block_.hostShadow[row] = map.texture != 0 ? glm::vec4(across, float(at)) : glm::vec4(0.0f);
    }
    const float nearer = map.depth == DepthConvention::Reversed ? -1.0f : 1.0f;
    block_.hostShadowEdge = {map.edge * glm::length(glm::vec3(block_.hostShadow[0])),
                             map.edge * glm::length(glm::vec3(block_.hostShadow[1])),
                             map.texture != 0 ? nearer : 0.0f, 0.0f};
    return before != std::array<glm::vec4, 4>{block_.hostShadow[0], block_.hostShadow[1],
                                              block_.hostShadow[2], block_.hostShadowEdge};
}

/// The first entry, black without sun.
void LightList::addSun(const LightListInputs& in)
{
    const Lighting& lighting = in.settings->lighting;
    SliceLightBlock light{};
    light.color = glm::vec4(lighting.sunIlluminance * exposureFromEv100(in.settings->exposureEv100), 0.0f);
    light.place = glm::vec4(lighting.sunDirection, 0.0f);
    sunTexel_ = 0.0f;
    if (in.settings->slices.enabled && lighting.sunIlluminance != glm::vec3(0.0f))
        sunTexel_ = addStacks(
            [&](const SliceFit& fit, SliceStack& outStack) {
                return fitParallelSlices(lighting.sunDirection, in.casters, in.eye,
                                         in.settings->slices.resolution, outStack, fit);
            },
            in.settings->slices.snapped, count_);
    add(light);
    origins_.push_back({LightKind::Sun, 0});
}

/// The sun's planes of a wide scene are coarse. A ball around the eye gets finer ones, in the last entries.
/// They are fitted to the ball, not to the media in it: these come and go while the eye moves.
void LightList::addCascades(const LightListInputs& in)
{
    const Lighting& lighting = in.settings->lighting;
    if (sunTexel_ <= 0.0f)
        return;
    float side = sunTexel_ * float(stacks_.front().resolution.texels);
    float coarserTexel = sunTexel_;
    for (count_ = kFinerPlanes; count_ < kMaxLightEntries && side > kWideScene; ++count_) {
        side *= kCascadeRatio;
        const float radius = 0.5f * side;
        const bool hasMedia = std::ranges::any_of(in.casters, [&](const MediumCaster& caster) {
            return glm::length(caster.center) < radius + caster.radius;
        });
        if (!hasMedia)
            return;
        // around a place that the eye is near to, so that planes are not filled again with each of its steps
        const double grid = double(side) * kCascadeGrid;
        const glm::vec3 middle(glm::round(in.eye / grid) * grid - in.eye);
        const MediumCaster around{middle, radius + 0.5f * std::numbers::sqrt3_v<float> * float(grid), 0.0f};
        const float texel = addStacks(
            [&](const SliceFit& fit, SliceStack& outStack) {
                return fitParallelSlices(lighting.sunDirection, {&around, 1}, in.eye,
                                         in.settings->slices.resolution, outStack, fit) &&
                       outStack.texel < coarserTexel;
            },
            in.settings->slices.snapped, count_);
        if (texel <= 0.0f)
            return;
        block_.lights[count_].place.w = radius;
        coarserTexel = texel;
    }
}

void LightList::addPoints(const LightListInputs& in)
{
    const SortedPoints sorted = sortedPoints(in);
    const float exposure = exposureFromEv100(in.settings->exposureEv100);
    for (size_t i = 0; i < sorted.count; ++i) {
        const HostLight& point = sorted.points[i].light;
        const glm::vec3 place(point.position - in.eye);
        SliceLightBlock light{};
        const LightOrigin& origin = sorted.points[i].origin;
        const bool isEffect = origin.kind == LightKind::Effect;
        const bool isOfMedium = isEffect && in.effects[origin.index].isOfMedium;
        const float begin =
            std::max(point.radius, isEffect ? in.effects[origin.index].ownReach : 0.0f); // of its shadow
        light.color = glm::vec4(point.intensity * exposure, isOfMedium ? 2.0f : 1.0f);
        light.place = glm::vec4(place, point.radius);
        light.cone = coneOf(point);
        if (in.settings->slices.enabled && int(i) < in.settings->slices.castingPoints)
            addStacks(
                [&](const SliceFit& fit, SliceStack& outStack) {
                    const bool isThere =
                        fitPointSlices(place, begin, in.casters, in.eye,
                                       partOf(in.settings->slices.resolution, 2), outStack, fit);
                    outStack.corner = point.position; // not by way of floats: it must not follow the eye
                    return isThere;
                },
                in.settings->slices.snapped, count_);
        add(light);
        origins_.push_back(origin);
    }
}

void LightList::addSky(const LightListInputs& in)
{
    const bool isDark =
        glm::vec3(block_.sky) == glm::vec3(0.0f) && glm::vec3(block_.ground) == glm::vec3(0.0f);
    if (isDark || !in.settings->slices.enabled)
        return;
    for (size_t i = 0; i < kSkyAxes; ++i) {
        const float turn = float(i) * (2.0f * kPi / 5.0f);
        const float across = std::sqrt(1.0f - kSkyAxisElevation * kSkyAxisElevation);
        const glm::vec3 axis =
            i == 0 ? glm::vec3(0, 1, 0)
                   : glm::vec3(across * std::cos(turn), kSkyAxisElevation, across * std::sin(turn));
        const float texel = addStacks(
            [&](const SliceFit& fit, SliceStack& outStack) {
                return fitParallelSlices(axis, in.casters, in.eye, partOf(in.settings->slices.resolution, 4),
                                         outStack, fit);
            },
            in.settings->slices.snapped, count_);
        if (texel <= 0.0f)
            return;
        SliceLightBlock light{};
        light.place = glm::vec4(axis, 0.0f);
        add(light);
    }
}

/// Planes of a light and, while they change their sides, those that it had before.
/// @param fit makes a stack  @param entry of the block  @return [m] side of texels, between that before and
/// that now, so that what is made from it has no jumps either; 0: there are no planes
template <class Fit>
float LightList::addStacks(const Fit& fit, bool isSnapped, size_t entry)
{
    SliceStack stack;
    if (!fit(SliceFit{isSnapped}, stack))
        return 0.0f;
    const SliceFade fade = isSnapped ? fades_.next(stack) : SliceFade();
    SliceStack before;
    const bool fades = fade.weight > 0.0f && fit(fade.before, before);
    if (isSnapped && (stack.texel != fade.now.texel || stack.spacing != fade.now.spacing))
        fit(fade.now, stack);
    addStack(stack, entry);
    if (fades) {
        addStack(before, entry + kFadingEntries);
        block_.lights[entry + kFadingEntries].color = glm::vec4(fade.weight, 0.0f, 0.0f, 0.0f);
    }
    return fades ? glm::mix(stack.texel, before.texel, fade.weight) : stack.texel;
}

void LightList::addStack(const SliceStack& stack, size_t entry)
{
    SliceLightBlock& ioLight = block_.lights[entry];
    if (stack.mapping == SliceMapping::Parallel) {
        const glm::vec3 right = stack.right / stack.texel, up = stack.up / stack.texel,
                        along = stack.along / stack.spacing;
        ioLight.right = glm::vec4(right, -glm::dot(right, stack.origin));
        ioLight.up = glm::vec4(up, -glm::dot(up, stack.origin));
        ioLight.along = glm::vec4(along, -glm::dot(along, stack.origin));
    } else {
        ioLight.along = {stack.first / stack.spacing, stack.begin, 0.0f, 1.0f / stack.spacing};
    }
    stacks_.push_back(stack);
    stackLights_.push_back(entry);
}

size_t LightList::costCount() const
{
    return size_t(block_.counts.x) + (block_.counts.y > 0 ? 1 : 0);
}

LightCost LightList::costOf(size_t light) const
{
    const auto points = size_t(block_.counts.x);
    LightCost cost;
    cost.origin = light < points ? origins_[light] : LightOrigin{LightKind::Sky, 0};
    for (size_t i = 0; i < stacks_.size(); ++i) {
        const size_t place = stackLights_[i] % kFadingEntries; // also of planes that fade out
        const size_t entry = place >= kFinerPlanes ? 0 : place;
        if (std::min(entry, points) != light)
            continue;
        const auto side = uint64_t(stacks_[i].resolution.texels);
        const auto planes = uint64_t(stacks_[i].resolution.planes);
        ++cost.stacks;
        cost.planes += uint32_t(planes);
        cost.texels += planes * side * side;
        cost.rays += side * side;
    }
    return cost;
}

/// Stacks lie side by side in rows; each row is as high as its first stack, the largest.
void LightList::placeTiles()
{
    atlasWidth_ = atlasHeight_ = mostTexels_ = mostPlanes_ = 0;
    for (const SliceStack& stack : stacks_) {
        mostTexels_ = std::max(mostTexels_, stack.resolution.texels);
        mostPlanes_ = std::max(mostPlanes_, stack.resolution.planes);
    }
    atlasWidth_ = mostTexels_ * kSliceTileColumns;
    placesRevision_ = 0;
    int x = 0, y = 0, rowHeight = 0;
    for (size_t i = 0; i < stacks_.size(); ++i) {
        const SliceStack& stack = stacks_[i];
        const SliceResolution& size = stack.resolution;
        const int width = size.texels * kSliceTileColumns;
        const int height = size.texels * ((size.planes + kSliceTileColumns - 1) / kSliceTileColumns);
        if (x + width > atlasWidth_) {
            y += rowHeight;
            x = rowHeight = 0;
        }
        const glm::vec4 tiles(float(x), float(y), float(size.texels), float(size.planes));
        block_.lights[stackLights_[i]].tiles = tiles;
        const bool isParallel = stack.mapping == SliceMapping::Parallel;
        stackBlocks_.push_back({glm::vec4(stack.origin, stack.spacing),
                                glm::vec4(stack.right * stack.texel, isParallel ? 0.0f : 1.0f),
                                glm::vec4(stack.up * stack.texel, stack.first),
                                glm::vec4(stack.along, stack.begin), tiles});
        placesRevision_ = revisionOf(placesRevision_, stack, tiles);
        x += width;
        rowHeight = std::max(rowHeight, height);
        atlasHeight_ = std::max(atlasHeight_, y + height);
    }
}

} // namespace fx::render
