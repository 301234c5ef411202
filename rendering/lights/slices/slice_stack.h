/// @file slice_stack.h
/// Geometry of the planes of a stack of light slices, and its fit to the shadow casters.
///
/// The first plane of a stack is nearest to the light. Each texel of a plane stores the optical depth of all
/// media between the light and the texel. For parallel light, planes are flat and perpendicular to the light.
/// For a point light, planes are spherical shells around the point, with an octahedral map of directions.
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
    Parallel,   ///< flat planes perpendicular to parallel light
    Octahedral, ///< shells around a point
};

/// least number of planes: one in front of the media, one within, and one behind
constexpr int kMinSlicePlanes = 3;
constexpr int kMaxSlicePlanes = 128;
constexpr int kMaxSliceTexels = 512; ///< largest number of texels along a side of a plane

/// Returns the resolution, clamped to the limits. The number of texels is rounded to a multiple of 8.
SliceResolution usableResolution(const SliceResolution& asked);

/// Coordinates in a stack. Texel centers are at x, y = 0.5, 1.5, ...; plane number k is at plane = k.
struct SlicePlace
{
    float x, y;
    float plane;
};

/// Planes of one light. All positions are relative to the eye.
struct SliceStack
{
    SliceMapping mapping = SliceMapping::Parallel;
    SliceResolution resolution;
    /// Unit vectors; `along` is the direction in which parallel light travels.
    glm::vec3 right{1, 0, 0}, up{0, 1, 0}, along{0, 0, 1};
    glm::vec3 origin{0}; ///< [m] corner of the first plane, or position of the point light
    /// World position of `origin`. For SliceMapping::Octahedral, the unit is [m]. For
    /// SliceMapping::Parallel, coordinates along `right` and `up` are in units of `texel`, and the
    /// coordinate along `along` is in units of `spacing`.
    glm::dvec3 corner{0};
    float texel = 1.0f;   ///< [m] side of a texel of flat planes
    float spacing = 1.0f; ///< [m] distance between two planes
    float first = 0.0f;   ///< [m] distance of the first shell from the point light; 0 for flat planes
    /// [m] Radius of the glowing gas that a point light represents. Media within this distance cast no
    /// shadow.
    float begin = 0.0f;

    SlicePlace placeOf(const glm::vec3& position) const;
    /// [m] distance of plane number `plane` along the ray of a texel
    float distanceOf(int plane) const { return first + float(plane) * spacing; }
};

/// The ray of a texel. It crosses plane k at the distance distanceOf(k) from `start`.
struct SliceRay
{
    glm::vec3 start;
    glm::vec3 direction; ///< unit vector
};

/// Returns the ray through a point of a plane.
/// @param x, y coordinates of the point, see SlicePlace
SliceRay sliceRay(const SliceStack& stack, float x, float y);

/// Requested sides of a stack (side of a texel, spacing of planes), and a flag for snapping to the world.
struct SliceFit
{
    /// True: sides and corner are snapped to a lattice in the world. False: sides and corner follow the
    /// casters exactly. Only measurements of the effect of snapping use false.
    bool isSnapped = true;
    float texel = 0.0f;   ///< [m] side of a texel; 0: as large as the casters require
    float spacing = 0.0f; ///< [m] spacing of planes; 0: as large as the casters require
};

/// Fits planes to all casters. Texels and planes are fixed in the world while the casters move. Texel side
/// and spacing are powers of 2^(1/4) m. The coordinates of the corner are multiples of texel side and
/// spacing.
/// @param towards unit vector to the light  @param eye [m] world position to which casters are relative
/// @param asked requested resolution, which is clamped to the limits; 0 planes: no stack
/// @return false if there are no casters or no planes
bool fitParallelSlices(const glm::vec3& towards, std::span<const MediumCaster> casters, const glm::dvec3& eye,
                       const SliceResolution& asked, SliceStack& outStack, const SliceFit& fit = {});

/// Fits shells around a glowing ball, from the nearest to the farthest caster. The distances of shells are
/// multiples of a power of 2^(1/4) m.
/// @param light [m] position of the ball relative to the eye  @param radius [m] radius of the ball
bool fitPointSlices(const glm::vec3& light, float radius, std::span<const MediumCaster> casters,
                    const glm::dvec3& eye, const SliceResolution& asked, SliceStack& outStack,
                    const SliceFit& fit = {});

} // namespace fx::render
