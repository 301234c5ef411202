#include "rendering/lights/slices/slice_stack.h"

#include "foundation/math/geometry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

constexpr float kMinSide = 1e-4f; ///< [m] of a texel, and between planes

/// The smallest power of 2^(1/4) that is not below x, so that small changes of x change nothing.
/// @param given what it is to be instead; 0: nothing
float quantizedSide(float x, bool isSnapped, float given)
{
    const float side = std::max(x, kMinSide);
    if (given > 0.0f)
        return given;
    return isSnapped ? std::exp2(std::ceil(4.0f * std::log2(side)) * 0.25f) : side;
}

/// A unit vector across `along`, near to the horizontal.
glm::vec3 acrossOf(const glm::vec3& along)
{
    const glm::vec3 reference = std::abs(along.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return glm::normalize(glm::cross(reference, along));
}

/// Octahedral map of a unit vector to [-1, 1]^2.
glm::vec2 octahedral(const glm::vec3& d)
{
    const float sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    const glm::vec2 p(d.x / sum, d.y / sum);
    if (d.z >= 0.0f)
        return p;
    return {(1.0f - std::abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f),
            (1.0f - std::abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f)};
}

/// Inverse of octahedral(); places a little outside of [-1, 1]^2 fold back to where the map goes on.
glm::vec3 octahedralDirection(glm::vec2 p)
{
    if (std::abs(p.x) > 1.0f)
        p = {std::copysign(2.0f, p.x) - p.x, -p.y};
    if (std::abs(p.y) > 1.0f)
        p = {-p.x, std::copysign(2.0f, p.y) - p.y};
    glm::vec3 d(p.x, p.y, 1.0f - std::abs(p.x) - std::abs(p.y));
    if (d.z < 0.0f)
        d = {(1.0f - std::abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f),
             (1.0f - std::abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f), d.z};
    return glm::normalize(d);
}

/// Extent of the casters along an axis, relative to the eye.
struct Extent
{
    float low = INFINITY, high = -INFINITY;
};

Extent extentAlong(const glm::vec3& axis, std::span<const MediumCaster> casters)
{
    Extent extent;
    for (const MediumCaster& caster : casters) {
        const float middle = glm::dot(caster.center, axis);
        extent.low = std::min(extent.low, middle - caster.radius);
        extent.high = std::max(extent.high, middle + caster.radius);
    }
    return extent;
}

/// The largest multiple of `side` in the world that is not above `low`, which is relative to the eye, as a
/// number. @param isSnapped false: `low` itself in sides
double snappedBelow(float low, float side, const glm::vec3& axis, const glm::dvec3& eye, bool isSnapped)
{
    constexpr double kRounding =
        1e-3; // [1] of a side: a rim that lies on a multiple must not turn it into the next one
    const double place = (glm::dot(eye, glm::dvec3(axis)) + double(low)) / double(side);
    return isSnapped ? std::floor(place - kRounding) : place;
}

} // namespace

SliceResolution usableResolution(const SliceResolution& asked)
{
    return {std::clamp((asked.texels + 7) / 8 * 8, 8, kMaxSliceTexels),
            std::clamp(asked.planes, kMinSlicePlanes, kMaxSlicePlanes)};
}

SlicePlace SliceStack::placeOf(const glm::vec3& position) const
{
    const glm::vec3 d = position - origin;
    if (mapping == SliceMapping::Parallel)
        return {glm::dot(d, right) / texel, glm::dot(d, up) / texel, glm::dot(d, along) / spacing};
    const float distance = glm::length(d);
    const glm::vec2 p = distance > 0.0f ? octahedral(d / distance) : glm::vec2(0.0f);
    const float inner = float(resolution.texels - 2); // a border of one texel lets neighbors be interpolated
    return {1.0f + (0.5f + 0.5f * p.x) * inner, 1.0f + (0.5f + 0.5f * p.y) * inner,
            (distance - first) / spacing};
}

SliceRay sliceRay(const SliceStack& stack, float x, float y)
{
    if (stack.mapping == SliceMapping::Parallel)
        return {stack.origin + (x * stack.texel) * stack.right + (y * stack.texel) * stack.up, stack.along};
    const float inner = float(stack.resolution.texels - 2);
    return {stack.origin,
            octahedralDirection({2.0f * (x - 1.0f) / inner - 1.0f, 2.0f * (y - 1.0f) / inner - 1.0f})};
}

bool fitParallelSlices(const glm::vec3& towards, std::span<const MediumCaster> casters, const glm::dvec3& eye,
                       const SliceResolution& asked, SliceStack& outStack, const SliceFit& fit)
{
    if (casters.empty() || asked.planes <= 0)
        return false;
    const SliceResolution resolution = usableResolution(asked);
    SliceStack stack;
    stack.mapping = SliceMapping::Parallel;
    stack.resolution = resolution;
    stack.along = -towards;
    stack.right = acrossOf(stack.along);
    stack.up = glm::cross(stack.along, stack.right);
    const Extent x = extentAlong(stack.right, casters);
    const Extent y = extentAlong(stack.up, casters);
    const Extent z = extentAlong(stack.along, casters);
    // a texel on each side stays free of media, and snapping moves the corner by up to another one
    stack.texel = quantizedSide(std::max(x.high - x.low, y.high - y.low) / float(resolution.texels - 3),
                                fit.isSnapped, fit.texel);
    // likewise snapping moves the first plane by up to one distance
    stack.spacing =
        quantizedSide((z.high - z.low) / float(resolution.planes - 2), fit.isSnapped, fit.spacing);
    stack.corner = {snappedBelow(x.low, stack.texel, stack.right, eye, fit.isSnapped) - 1.0,
                    snappedBelow(y.low, stack.texel, stack.up, eye, fit.isSnapped) - 1.0,
                    snappedBelow(z.low, stack.spacing, stack.along, eye, fit.isSnapped)};
    const glm::dvec3 world = stack.corner.x * double(stack.texel) * glm::dvec3(stack.right) +
                             stack.corner.y * double(stack.texel) * glm::dvec3(stack.up) +
                             stack.corner.z * double(stack.spacing) * glm::dvec3(stack.along);
    const auto across = [&](const glm::vec3& axis) {
        return axis * float(glm::dot(world - eye, glm::dvec3(axis)));
    };
    stack.origin = across(stack.right) + across(stack.up) + across(stack.along);
    outStack = stack;
    return true;
}

bool fitPointSlices(const glm::vec3& light, float radius, std::span<const MediumCaster> casters,
                    const glm::dvec3& eye, const SliceResolution& asked, SliceStack& outStack,
                    const SliceFit& fit)
{
    if (casters.empty() || asked.planes <= 0)
        return false;
    const SliceResolution resolution = usableResolution(asked);
    float nearest = INFINITY, farthest = 0.0f;
    for (const MediumCaster& caster : casters) {
        const float distance = glm::length(caster.center - light);
        nearest = std::min(nearest, distance - caster.radius);
        farthest = std::max(farthest, distance + caster.radius);
    }
    SliceStack stack;
    stack.mapping = SliceMapping::Octahedral;
    stack.resolution = resolution;
    stack.origin = light;
    stack.corner = eye + glm::dvec3(light);
    const bool isOutside = nearest > 0.0f;
    stack.spacing =
        quantizedSide(farthest / float(resolution.planes - 1), fit.isSnapped, isOutside ? 0.0f : fit.spacing);
    const float closer =
        quantizedSide((farthest - nearest) / float(resolution.planes - 2), fit.isSnapped, fit.spacing);
    if (isOutside && closer < stack.spacing) { // no shells before the media
        stack.spacing = closer;
        stack.first = fit.isSnapped ? std::floor(nearest / closer) * closer : nearest;
    }
    stack.begin = radius;
    outStack = stack;
    return true;
}

} // namespace fx::render
