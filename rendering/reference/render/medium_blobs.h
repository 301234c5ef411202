/// @file medium_blobs.h
/// The medium as input of the reference renderer: one list of balls in world coordinates.
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/block_kind.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/reference/render/medium_details.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace fx::render {

/// One ball with the quartic kernel.
struct MediumBlob
{
    glm::dvec3 center{0.0};    ///< [m] position of the center in the world
    double radius = 0.0;       ///< [m] > 0
    double crossSection = 0.0; ///< [m2] integral of the ball's extinction over space, > 0
    glm::dvec3 albedo{0.0};    ///< [1]
    glm::dvec3 source{0.0};    ///< [cd/m2] emitted light per optical depth
    double anisotropy = 0.0;   ///< [1] mean cosine g of the Henyey-Greenstein phase function
    /// [1] fraction of the opacity that belongs to the layer Fire
    double fireShare = 0.0;
    base::MediaLayer layer = base::MediaLayer::Smoke; ///< layer to which the remaining opacity belongs
    uint64_t instance = 0;                            ///< instance of the scene to which the ball belongs
    glm::dvec3 velocity{0.0};                         ///< [m/s] velocity in the world
    double temperature = 0.0;                         ///< [K]; the emitted light is in `source`
    uint64_t id = 0;                                  ///< id of the ball in its group of the snapshot
    double age = double(base::kSettledAge);           ///< [s] since its birth, as the snapshot has it
    /// [1/s] change of the logarithm of the luminance of `source` between the snapshots; 0: not known
    double sourceRate = 0.0;
};

/// Returns the medium of a volume of a snapshot at its moment; null if it is not known.
using VolumeLookup = std::function<std::shared_ptr<const MediumVolume>(const GroupVolume&)>;

/// Blobs of all groups, and the number of blobs that were omitted because a value was not finite.
struct MediumList
{
    std::vector<MediumBlob> blobs;
    MediumDetails details; ///< detail of `blobs`
    uint32_t nonFinite = 0;
};

/// The blobs of two snapshots at a moment between them. Matching by id, interpolation, extrapolation of
/// newborn blobs and streaks follow the rules of rendering/media/blob_gather.h. This function does not cull
/// blobs and does not enlarge them to a pixel. Positions have double precision.
///
/// source = (1 - albedo) black body + emission. The detail of fields is included. The noise of single balls
/// (`detailAmount`) is omitted; only GPU passes have this noise.
/// @param interpolation moment between the older (0) and the newer (1) snapshot
/// @param volumes finds the voxels of groups of blobs that stand for a volume; where it is empty or returns
///        null, the blobs are the medium
MediumList mediumOf(const base::SnapshotPair& snapshots, double interpolation,
                    const VolumeLookup& volumes = {});

} // namespace fx::render
