/// @file blob_gather.h
/// Interpolates the blobs of two snapshots, and lists the blobs in eye-relative coordinates.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/field_detail/conservation_factor.h"
#include "rendering/frame/view_block.h"
#include "rendering/lights/medium_caster.h"
#include "rendering/lod/impostor_field.h"
#include "rendering/lod/level_of_detail.h"
#include "rendering/media/late_balls.h"
#include "rendering/volumes/volume_place.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::render {

/// Range of an instance's blobs in the list of visible blobs.
struct InstanceBlobs
{
    uint64_t instance;
    size_t visibleBegin, visibleEnd;
    ImpostorPlan plan; ///< whether the instance is drawn as blobs, as an impostor, or as both
};

/// Consecutive blobs of an instance: the blobs of one group with detail or with a volume, or of consecutive
/// groups without.
struct BlobRun
{
    size_t instance;                 ///< index in the list of instances
    int detail;                      ///< index of the detail of the group; -1: no detail
    size_t visibleBegin, visibleEnd; ///< range among the visible blobs
    size_t mediumBegin, mediumEnd;   ///< range among all blobs, visible or not
    int volume = -1;                 ///< index of the volume of the group; -1: no volume
};

/// Additional data, for blobs that are drawn as fields.
struct FieldGather
{
    explicit FieldGather(std::pmr::memory_resource* memory)
        : details(memory), volumes(memory), runs(memory), casters(memory), conservation(memory)
    {}
    std::pmr::vector<GroupDetail> details;
    std::pmr::vector<GroupVolume> volumes;
    std::pmr::vector<BlobRun> runs;
    std::pmr::vector<DetailedCaster> casters; ///< balls of the last group with detail
    ConservationFactor conservation;
};

/// Number of omitted blobs, by reason.
struct GatherCounts
{
    uint32_t culled = 0;
    uint32_t nonFinite = 0;
    uint32_t thinned = 0; ///< number of blobs that the level of detail omitted
};

/// Appends every visible blob to `outVisible`, in the order of groups and ids. Appends every blob to
/// `outMedium`, because invisible blobs may cast shadows into the picture.
///
/// `outInstances` gets the range of each instance in `outVisible`.
///
/// Elements of the two snapshots are matched by id and interpolated. If only the newer snapshot has an
/// element, the element is extrapolated back along its velocity, and omitted before its birth. Blobs smaller
/// than a pixel are enlarged to a pixel; their mean opacity over the picture does not change (formula
/// widened-ball). So small blobs neither vanish nor flicker. With a shutter, a moving blob becomes a streak,
/// see foundation/snapshot/streak.h.
///
/// @param share fraction of the blobs that is appended to `outVisible`, (0, 1]. Blobs are selected by id, so
///     that the selection does not flicker. The cross sections of selected blobs are increased to represent
///     the omitted blobs. All blobs cast shadows.
/// @param impostors selects the effects that are drawn as impostors; null: none. If an effect is drawn only
///     as an impostor, its blobs are not gathered. At most 16 of its blobs are appended to `outMedium`, to
///     represent the shadow of all blobs. If an impostor is rendered in this frame, its blobs are gathered
///     also outside of the view.
/// @param lod reduces the number of blobs of groups that are small on the picture, also for shadows; null:
///     no reduction
/// @param castsShadows true: effects that are drawn only as an impostor cast shadows
/// @param late balls of late groups whose rows are not read; sorted as the groups. They are neither thinned
/// nor
///     drawn as impostors of effects
/// @param outFields receives the detail and the volumes of groups, and runs of blobs; may be null. Blobs that
///     stand for a volume are then not thinned, and cast shadows as balls that their bricks contain
/// @param otherEye camera whose view is not culled either; null: none
GatherCounts gatherBlobs(const base::SnapshotPair& snapshots, double interpolation,
                         const CameraGeometry& camera, int height, std::pmr::vector<GatheredBlob>& outVisible,
                         std::pmr::vector<MediumCaster>& outMedium,
                         std::pmr::vector<InstanceBlobs>& outInstances, float share = 1.0f,
                         LevelOfDetail* lod = nullptr, ImpostorField* impostors = nullptr,
                         bool castsShadows = true, FieldGather* outFields = nullptr,
                         std::span<const LateBalls> late = {}, const CameraGeometry* otherEye = nullptr);

} // namespace fx::render
