/// @file blob_gather.h
/// Collects the blobs of a pair of snapshots as one list in eye-relative coordinates, at a moment between the
/// two.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/field_detail/blob_detail.h"
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
    std::array<glm::vec3, 2> carried{}; ///< [cell] coordinates of both generations, see BlobDetail
};

/// Blobs of one instance, as a range of those that can be seen.
struct InstanceBlobs
{
    uint64_t instance;
    size_t visibleBegin, visibleEnd;
    ImpostorPlan plan; ///< what of it is drawn as a picture
};

/// Blobs that follow each other in an instance: all of a group with detail, or of neighboring groups without.
struct BlobRun
{
    size_t instance;                 ///< number in the list of instances
    int detail;                      ///< number of the group's detail; -1: none
    size_t visibleBegin, visibleEnd; ///< of those that can be seen
    size_t mediumBegin, mediumEnd;   ///< of all, seen or not
};

/// What fields of blobs need besides.
struct FieldGather
{
    explicit FieldGather(std::pmr::memory_resource* memory) : details(memory), runs(memory) {}
    std::pmr::vector<GroupDetail> details;
    std::pmr::vector<BlobRun> runs;
};

/// What a gather left out.
struct GatherCounts
{
    uint32_t culled = 0;
    uint32_t nonFinite = 0;
    uint32_t thinned = 0; ///< for the level of detail
};

/// Appends to `outVisible` every blob that can be seen, in the order of groups and ids, and to `outMedium`
/// every blob whether seen or not: what is beside the picture still casts its shadow into it.
///
/// `outInstances` gets the range of each instance in `outVisible`.
///
/// Elements are matched by id between the two snapshots and interpolated; one that is only in the newer is
/// carried back along its velocity, and left out if it was not yet born. Blobs smaller than a pixel are
/// widened to it with their cross section kept, so that they neither vanish nor flicker; a shutter draws a
/// moving blob out into a streak, see foundation/snapshot/streak.h.
///
/// @param share of the particles that is appended to `outVisible`, (0, 1]: their ids decide which, so that a
/// particle does not come and go; they take over the cross section of the others. All cast shadows.
/// @param impostors decides which effects are pictures of themselves; null: none. What is drawn by a picture
/// alone is not gathered, but at most 16 of its blobs cast the shadow of all; what is taken for one is
/// gathered with all that is beside the view.
/// @param lod thins out groups that are small on the picture, for shadows too; null: none
/// @param castsShadows whether what is drawn by a picture alone casts a shadow
/// @param outFields gets the detail of groups, and runs of blobs; null: they are not needed
GatherCounts gatherBlobs(const base::SnapshotPair& snapshots, double interpolation,
                         const CameraGeometry& camera, int height, std::pmr::vector<GatheredBlob>& outVisible,
                         std::pmr::vector<MediumCaster>& outMedium,
                         std::pmr::vector<InstanceBlobs>& outInstances, float share = 1.0f,
                         LevelOfDetail* lod = nullptr, ImpostorField* impostors = nullptr,
                         bool castsShadows = true, FieldGather* outFields = nullptr);

} // namespace fx::render
