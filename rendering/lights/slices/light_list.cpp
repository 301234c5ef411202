#include "rendering/lights/slices/light_list.h"

#include "foundation/math/bits.h"
#include "foundation/math/hash.h"
#include "rendering/frame/exposure.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Planes of lights at points and of the axes of the sky, relative to those of the sun.
SliceResolution partOf(const SliceResolution& sun, int part)
{
    return {sun.texels / part, (sun.planes + part - 1) / part};
}

SliceResolution pointResolution(const SliceResolution& sun)
{
    return partOf(sun, 2);
}

SliceResolution skyResolution(const SliceResolution& sun)
{
    return partOf(sun, 4);
}

/// What light arrives from a point at the middle of the casters decides which points cast shadows.
float arriving(const HostLight& light, const glm::dvec3& middle)
{
    const glm::dvec3 d = light.position - middle;
    const float brightness = light.intensity.x + light.intensity.y + light.intensity.z;
    return brightness / float(glm::dot(d, d) + double(light.radius) * double(light.radius) + 1e-6);
}

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
    std::array<HostLight, kMostEffectLights + kMostHostLights> points;
    size_t count = 0;

    void add(const HostLight& light)
    {
        const double numbers[] = {light.position.x,  light.position.y,  light.position.z, light.intensity.x,
                                  light.intensity.y, light.intensity.z, light.radius};
        if (std::ranges::all_of(numbers, [](double x) { return base::isFinite(x); }) &&
            light.intensity != glm::vec3(0.0f))
            points[count++] = light;
    }
    std::span<const HostLight> all() const { return std::span(points).first(count); }
};

SortedPoints sortedPoints(const LightListInputs& in)
{
    SortedPoints sorted;
    for (const EffectLight& light : in.effects.first(std::min(in.effects.size(), kMostEffectLights)))
        sorted.add(pointOf(light));
    for (size_t i = 0; i < in.settings->hostLights.count; ++i)
        sorted.add(in.settings->hostLights.lights[i]);
    const glm::dvec3 middle = middleOf(in.casters, in.eye);
    const auto isBrighter = [&](const HostLight& a, const HostLight& b) {
        return arriving(a, middle) > arriving(b, middle);
    };
    const auto first = sorted.points.begin(); // by insertion: std::stable_sort takes memory
    for (auto light = first; light != first + ptrdiff_t(sorted.count); ++light)
        std::rotate(std::upper_bound(first, light, *light, isBrighter), light, light + 1);
    return sorted;
}

size_t castingPoints(const SliceSettings& slices, const SortedPoints& sorted)
{
    return std::min(size_t(std::max(slices.castingPoints, 0)), sorted.count);
}

/// [cd/m2] of the ground, from below.
glm::vec3 groundLuminance(const Lighting& lighting)
{
    const glm::vec3 sun = lighting.sunIlluminance * (std::max(lighting.sunDirection.y, 0.0f) / kPi);
    return lighting.groundAlbedo * (sun + lighting.skyLuminance);
}

bool hasSky(const Lighting& lighting)
{
    return lighting.skyLuminance != glm::vec3(0.0f) || groundLuminance(lighting) != glm::vec3(0.0f);
}

uint64_t mixed(uint64_t hash, const glm::dvec3& v)
{
    for (int i = 0; i < 3; ++i)
        hash = base::hashWord(hash, std::bit_cast<uint64_t>(v[i]));
    return hash;
}

} // namespace

LightList::LightList(std::pmr::memory_resource* memory)
    : lights_(memory), stacks_(memory), stackLights_(memory), stackBlocks_(memory), origins_(memory),
      kept_(memory), keptOrigins_(memory)
{}

uint64_t LightList::planesKey(const LightListInputs& in)
{
    const Lighting& lighting = in.settings->lighting;
    const SliceSettings& slices = in.settings->slices;
    if (!slices.enabled)
        return 0;
    const SortedPoints sorted = sortedPoints(in);
    const size_t casting = castingPoints(slices, sorted);
    uint64_t key =
        base::hashWord(uint64_t(slices.resolution.texels) << 32 | uint64_t(slices.resolution.planes),
                       uint64_t(casting) << 2 | uint64_t(hasSky(lighting)) << 1 |
                           uint64_t(lighting.sunIlluminance != glm::vec3(0.0f)));
    key = mixed(key, glm::dvec3(lighting.sunDirection));
    for (const HostLight& light : sorted.all().first(casting))
        key = base::hashWord(mixed(key, light.position), std::bit_cast<uint32_t>(light.radius));
    return key;
}

void LightList::build(const LightListInputs& in, bool keepsPlanes)
{
    kept_.clear();
    keptOrigins_.clear();
    if (keepsPlanes) {
        kept_.swap(stacks_);
        keptOrigins_.swap(origins_);
    }
    lights_.clear();
    stacks_.clear();
    origins_.clear();
    stackLights_.clear();
    stackBlocks_.clear();
    const Lighting& lighting = in.settings->lighting;
    const float exposure = exposureFromEv100(in.settings->exposureEv100);
    head_.sky = glm::vec4(lighting.skyLuminance * exposure, in.settings->slices.multiple ? 1.0f : 0.0f);
    head_.ground = glm::vec4(groundLuminance(lighting) * exposure, 0.0f);
    addSun(in);
    addPoints(in);
    head_.counts = {int(lights_.size()), 0, in.settings->slices.samples, 0};
    addSky(in);
    head_.counts.y = int(lights_.size()) - head_.counts.x;
    placeTiles();
}

void LightList::addSun(const LightListInputs& in)
{
    const Lighting& lighting = in.settings->lighting;
    if (lighting.sunIlluminance == glm::vec3(0.0f))
        return;
    SliceLightBlock light{};
    light.color = glm::vec4(lighting.sunIlluminance * exposureFromEv100(in.settings->exposureEv100), 0.0f);
    light.place = glm::vec4(lighting.sunDirection, 0.0f);
    light.cone = {0.0f, 0.0f, 0.0f, 1.0f};
    SliceStack stack;
    if (in.settings->slices.enabled &&
        (takeKept(in.eye, stack) ||
         fitParallelSlices(lighting.sunDirection, in.casters, in.eye, in.settings->slices.resolution, stack)))
        addStack(stack, in.eye, light);
    lights_.push_back(light);
}

void LightList::addPoints(const LightListInputs& in)
{
    const SortedPoints sorted = sortedPoints(in);
    const size_t casting = castingPoints(in.settings->slices, sorted);
    const std::span<const HostLight> points = sorted.all();
    const float exposure = exposureFromEv100(in.settings->exposureEv100);
    for (size_t i = 0; i < points.size(); ++i) {
        const glm::vec3 place(points[i].position - in.eye);
        SliceLightBlock light{};
        light.color = glm::vec4(points[i].intensity * exposure, 1.0f);
        light.place = glm::vec4(place, points[i].radius);
        light.cone = coneOf(points[i]);
        SliceStack stack;
        if (in.settings->slices.enabled && i < casting &&
            (takeKept(in.eye, stack) ||
             fitPointSlices(place, points[i].radius, in.casters,
                            pointResolution(in.settings->slices.resolution), stack)))
            addStack(stack, in.eye, light);
        lights_.push_back(light);
    }
}

void LightList::addSky(const LightListInputs& in)
{
    if (!hasSky(in.settings->lighting) || !in.settings->slices.enabled)
        return;
    for (size_t i = 0; i < kSkyAxes; ++i) {
        const float turn = float(i) * (2.0f * kPi / 5.0f);
        const float across = std::sqrt(1.0f - kSkyAxisElevation * kSkyAxisElevation);
        const glm::vec3 axis =
            i == 0 ? glm::vec3(0, 1, 0)
                   : glm::vec3(across * std::cos(turn), kSkyAxisElevation, across * std::sin(turn));
        SliceStack stack;
        if (!takeKept(in.eye, stack) &&
            !fitParallelSlices(axis, in.casters, in.eye, skyResolution(in.settings->slices.resolution),
                               stack))
            return;
        SliceLightBlock light{};
        light.place = glm::vec4(axis, 0.0f);
        addStack(stack, in.eye, light);
        lights_.push_back(light);
    }
}

/// The planes that the next light had when the list was built last.
bool LightList::takeKept(const glm::dvec3& eye, SliceStack& outStack) const
{
    if (stacks_.size() >= kept_.size())
        return false;
    outStack = kept_[stacks_.size()];
    outStack.origin = glm::vec3(keptOrigins_[stacks_.size()] - eye);
    return true;
}

/// A kept stack has the place that it was given first, so that rounding does not add up from frame to frame.
glm::dvec3 LightList::originInWorld(const glm::dvec3& eye, const SliceStack& stack) const
{
    return stacks_.size() < keptOrigins_.size() ? keptOrigins_[stacks_.size()]
                                                : eye + glm::dvec3(stack.origin);
}

/// Its light is the next one of the list.
void LightList::addStack(const SliceStack& stack, const glm::dvec3& eye, SliceLightBlock& ioLight)
{
    if (stack.mapping == SliceMapping::Parallel) {
        const glm::vec3 right = stack.right / stack.texel, up = stack.up / stack.texel,
                        along = stack.along / stack.spacing;
        ioLight.right = glm::vec4(right, -glm::dot(right, stack.origin));
        ioLight.up = glm::vec4(up, -glm::dot(up, stack.origin));
        ioLight.along = glm::vec4(along, -glm::dot(along, stack.origin));
    } else {
        ioLight.along = {stack.first / stack.spacing, 0.0f, 0.0f, 1.0f / stack.spacing};
    }
    origins_.push_back(originInWorld(eye, stack));
    stacks_.push_back(stack);
    stackLights_.push_back(lights_.size());
}

/// Stacks lie side by side in rows; each row is as high as its first stack, the largest.
void LightList::placeTiles()
{
    atlasWidth_ = atlasHeight_ = mostTexels_ = 0;
    for (const SliceStack& stack : stacks_)
        mostTexels_ = std::max(mostTexels_, stack.resolution.texels);
    atlasWidth_ = mostTexels_ * kSliceTileColumns;
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
        lights_[stackLights_[i]].tiles = tiles;
        const bool isParallel = stack.mapping == SliceMapping::Parallel;
        stackBlocks_.push_back({glm::vec4(stack.origin, stack.spacing),
                                glm::vec4(stack.right * stack.texel, isParallel ? 0.0f : 1.0f),
                                glm::vec4(stack.up * stack.texel, stack.first),
                                glm::vec4(stack.along, stack.begin), tiles});
        x += width;
        rowHeight = std::max(rowHeight, height);
        atlasHeight_ = std::max(atlasHeight_, y + height);
    }
}

} // namespace fx::render
