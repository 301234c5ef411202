/// @file medium_blobs.h
/// The medium as the reference renderer gets it: one list of balls in world coordinates.
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/reference/render/medium_details.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace fx::render {

/// One ball with the quartic kernel.
struct MediumBlob
{
    glm::dvec3 center{0.0};                           ///< [m] world
    double radius = 0.0;                              ///< [m] > 0
    double crossSection = 0.0;                        ///< [m2] > 0: the integral of its extinction over space
    glm::dvec3 albedo{0.0};                           ///< [1]
    glm::dvec3 source{0.0};                           ///< [cd/m2] emitted light per optical depth
    double anisotropy = 0.0;                          ///< [1] Henyey-Greenstein g of scattering
    double fireShare = 0.0;                           ///< [1] of the opacity that counts as fire
    base::MediaLayer layer = base::MediaLayer::Smoke; ///< takes the rest
    uint64_t instance = 0;                            ///< of the scene; what it is part of
    glm::dvec3 velocity{0.0};                         ///< [m/s] world, of what is shown
};

/// Blobs of all groups and how many were left out because a number was not finite.
struct MediumList
{
    std::vector<MediumBlob> blobs;
    MediumDetails details; ///< of `blobs`
    uint32_t nonFinite = 0;
};

/// The blobs of a pair of snapshots at a moment between them, by the rules of rendering/media/blob_gather.h:
/// matched by id, interpolated, newborn ones carried back, moving ones drawn out along the shutter. Unlike
/// there, nothing is culled or widened to a pixel, and positions are double.
///
/// source = (1 - albedo) black body + emission. The detail of fields is found as for these passes; that of
/// balls by themselves (`detailAmount`) is a look of the GPU passes and is left out.
/// @param interpolation 0 older .. 1 newer
MediumList mediumOf(const base::SnapshotPair& snapshots, double interpolation);

} // namespace fx::render
