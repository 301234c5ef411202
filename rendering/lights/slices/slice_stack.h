/// @file slice_stack.h
/// Geometry of the planes of a stack of light slices, and its fit to the shadow casters.
///
/// A stack follows the light: its first plane is nearest to the light, and a plane stores at each texel the
/// optical depth of all media between the light and that texel. Planes of parallel light are flat and
/// perpendicular to it. Those of a light at a point are shells around it, with an octahedral map of
/// directions.
#pragma once

#include "rendering/frame/view_types.h"
#include "rendering/lights/medium_caster.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>

namespace fx::render {

enum class SliceMapping : uint8_t
{
    Parallel,   ///< flat planes across parallel light
    Octahedral, ///< shells around a point
};

constexpr int kMinSlicePlanes = 3; ///< before, within and behind the media, for any shift by snapping
constexpr int kMaxSlicePlanes = 128;
constexpr int kMaxSliceTexels = 512; ///< along a side

/// The resolution clamped to the limits, with texels rounded to a multiple of 8.
SliceResolution usableResolution(const SliceResolution& asked);

/// A place in a stack. Texel centers are at x, y = 0.5, 1.5, ...; plane number k is at plane = k.
struct SlicePlace
{
    float x, y;
    float plane;
};

/// Planes of one light. Positions are relative to a point (the eye) that is the same for all calls.
struct SliceStack
{
    SliceMapping mapping = SliceMapping::Parallel;
    SliceResolution resolution;
    /// Unit; `along` is the direction of parallel light.
    glm::vec3 right{1, 0, 0}, up{0, 1, 0}, along{0, 0, 1};
    glm::vec3 origin{0}; ///< [m] corner of the first plane, or the light's place
    glm::dvec3 corner{
        0};             ///< `origin` in the world: in texels, texels and planes, or [m] of a light at a point
    float texel = 1.0f; ///< [m] side of a texel of flat planes
    float spacing = 1.0f; ///< [m] between two planes
    float first = 0.0f;   ///< [m] distance of the first shell from a point; 0 for flat planes
    float begin =
        /// [m] distance from a point light up to which media cast no shadow: the radius of its glowing gas.
        0.0f;

    SlicePlace placeOf(const glm::vec3& position) const;
    float distanceOf(int plane) const
    {
        return first + float(plane) * spacing;
    } ///< [m] along the ray of a texel
};

/// The ray of a texel: it passes plane k at the distance distanceOf(k) from `start`.
struct SliceRay
{
    glm::vec3 start;
    glm::vec3 direction; ///< unit
};

/// @param x, y of a texel's center, see SlicePlace
SliceRay sliceRay(const SliceStack& stack, float x, float y);

/// Sides that a stack is to have, and whether it keeps its places in the world.
struct SliceFit
{
    bool isSnapped =
        /// False: sides and corner are those of the casters, to measure the effect of snapping.
        true;
    float texel = 0.0f;   ///< [m] 0: as large as the casters need, as the next
    float spacing = 0.0f; ///< [m]
};

/// Fits planes to all casters. Texels and planes are fixed in the world while the casters move: the sides are
/// powers of 2^(1/4), the corner is a multiple of them.
/// @param towards unit, to the light  @param eye [m] world position that casters are relative to
/// @param asked clamped to a usable resolution; no planes: no stack
/// @return false without casters or planes
bool fitParallelSlices(const glm::vec3& towards, std::span<const MediumCaster> casters, const glm::dvec3& eye,
                       const SliceResolution& asked, SliceStack& outStack, const SliceFit& fit = {});

/// Fits shells around a glowing ball, from the nearest to the farthest caster. Their distances are multiples
/// of a power of 2^(1/4).  @param light [m] relative to the eye  @param radius [m] of the ball
bool fitPointSlices(const glm::vec3& light, float radius, std::span<const MediumCaster> casters,
                    const glm::dvec3& eye, const SliceResolution& asked, SliceStack& outStack,
                    const SliceFit& fit = {});

} // namespace fx::render
