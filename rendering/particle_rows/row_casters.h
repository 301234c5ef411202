/// @file row_casters.h
/// Converts rows of particles and ribbons to balls of medium that cast shadows.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/lights/medium_caster.h"
#include "rendering/particle_rows/row_technique.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

struct RowCasterInputs
{
    const base::SnapshotPair* snapshots;
    std::span<const RowTechnique* const> techniques;
    double interpolation;               ///< moment between the older (0) and the newer (1) snapshot
    glm::dvec3 eye;                     ///< [m] world
    std::span<const uint8_t> left = {}; ///< for each group of the newer snapshot: 1 if the group is omitted
};

/// Appends to `ioCasters` the balls that represent all groups, visible or not. A group with more than
/// kMaxGroupCasters rows is divided into runs of equal length. The first row of a run represents the run:
/// its ball gets the total cross section of the run, and a volume that is increased in proportion. If there
/// are many groups, each group gets fewer casters. Rows that the GPU computes cast no shadow.
void gatherRowCasters(const RowCasterInputs& in, std::pmr::vector<MediumCaster>& ioCasters);

constexpr uint32_t kMaxGroupCasters = 256;
/// Largest total number of casters per call, unless kMinGroupCasters per group give more.
constexpr uint32_t kMaxRowCasters = 4096;
constexpr uint32_t kMinGroupCasters = 8;

/// Enlarges casters that are so small that they could lie between the texels of light slices. The light
/// slices are fitted to `all`. Cross sections do not change.
/// @param texels number of texels along a side of a plane
void widenCasters(std::span<MediumCaster> ioCasters, std::span<const MediumCaster> all, int texels);

/// [m2] Cross section of a ball that has the optical depth `depth` through its center: the inverse of the
/// formula kernel-optical-depth.
/// @param depth [1]  @param radius [m]
float crossSectionOfDepth(float depth, float radius);

/// [1] Optical depth of a surface with the given opacity, 0..1. Opacities above kMaxOpacity are clamped.
float depthOfOpacity(float opacity);
constexpr float kMaxOpacity = 0.999f;

} // namespace fx::render
