/// @file blob_gather.h
/// Collects the blobs of a pair of snapshots as one list in eye-relative coordinates, at a moment between the
/// two.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/field_detail/conservation_factor.h"
#include "rendering/frame/view_block.h"
#include "rendering/lights/medium_caster.h"
#include "rendering/lod/impostor_field.h"
#include "rendering/lod/level_of_detail.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::render {

/// A blob as seen from the eye, before light.
struct GatheredBlob
{
    glm::vec3 center;                   ///< [m] relative to the eye, world axes
    float radius;                       ///< [m] > 0
    float crossSection;                 ///< [m2] > 0
    float temperature;                  ///< [K]
    glm::vec3 albedo;                   ///< [1]
    glm::vec3 emission;                 ///< [cd/m2] besides the black body
    float fireShare;                    ///< [1]
    float heat;                         ///< [K]
    float seed;                         ///< [0, 1) of procedural detail, from the id
    float detailAmount;                 ///< [1]
    float detailScale;                  ///< [1]
    float anisotropy;                   ///< [1]
    uint32_t layer;                     ///< MediaLayer
    int detail = -1;                    ///< number of its group's detail; -1: it has none
    glm::vec3 velocity{0.0f};           ///< [m/s] relative to the world
    std::array<glm::vec3, 2> carried{}; ///< [cell] coordinates of both generations, see BlobDetail
};

/// Range of the blobs of one instance among the visible ones.
struct InstanceBlobs
{
    uint64_t instance;
    size_t visibleBegin, visibleEnd;
    ImpostorPlan plan; ///< its impostor
};

/// Blobs that follow each other in an instance: all of a group with detail, or of neighboring groups without.
struct BlobRun
{
    size_t instance;                 ///< number in the list of instances
    int detail;                      ///< number of the group's detail; -1: none
    size_t visibleBegin, visibleEnd; ///< range among the visible blobs
    size_t mediumBegin, mediumEnd;   ///< number of all blobs, visible or not
};

/// Further data for fields of blobs.
struct FieldGather
{
    explicit FieldGather(std::pmr::memory_resource* memory)
        : details(memory), runs(memory), casters(memory), conservation(memory)
    {}
    std::pmr::vector<GroupDetail> details;
    std::pmr::vector<BlobRun> runs;
    std::pmr::vector<DetailedCaster> casters; ///< of the last group with detail
    ConservationFactor conservation;
};

/// Numbers of omitted blobs.
struct GatherCounts
{
    uint32_t culled = 0;
    uint32_t nonFinite = 0;
    uint32_t thinned = 0; ///< for the level of detail
};

/// Appends to `outVisible` every visible blob, in the order of groups and ids, and to `outMedium` every blob,
/// because blobs outside of the picture cast shadows into it.
///
/// `outInstances` gets the range of each instance in `outVisible`.
///
/// Elements are matched by id between the two snapshots and interpolated; an element of only the newer one is
/// extrapolated back along its velocity, and omitted before its birth. Blobs smaller than a pixel are widened
/// to it, so that they neither vanish nor flicker; their mean opacity over the picture stays, see
/// widened-ball. With a shutter a moving blob becomes a streak, see foundation/snapshot/streak.h.
///
/// @param share of the particles that is appended to `outVisible`, (0, 1]: selected by id, so that particles
///         do not flicker; they take over the cross section of the others. All cast shadows.
/// @param impostors selects the effects that are drawn as impostors; null: none. Blobs of an effect that is
///         drawn by its impostor alone are not gathered, but at most 16 of them cast the shadow of all; blobs
///         for re-rendering an impostor are gathered also outside of the view.
/// @param lod thins out groups that are small on the picture, for shadows too; null: none
/// @param castsShadows whether effects that are drawn by an impostor alone cast shadows
/// @param outFields receives the detail of groups, and runs of blobs; may be null
GatherCounts gatherBlobs(const base::SnapshotPair& snapshots, double interpolation,
                         const CameraGeometry& camera, int height, std::pmr::vector<GatheredBlob>& outVisible,
                         std::pmr::vector<MediumCaster>& outMedium,
                         std::pmr::vector<InstanceBlobs>& outInstances, float share = 1.0f,
                         LevelOfDetail* lod = nullptr, ImpostorField* impostors = nullptr,
                         bool castsShadows = true, FieldGather* outFields = nullptr);

} // namespace fx::render
