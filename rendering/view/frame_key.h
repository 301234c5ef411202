/// @file frame_key.h
/// Key of all inputs of a frame's gathered data. While the key does not change, the gathered, sorted and
/// uploaded data of the last frame are reused.
#pragma once

#include "foundation/assets/volume_sequence.h"
#include "foundation/math/hash.h"
#include "rendering/frame/snapshot_revisions.h"
#include "rendering/frame/view_types.h"

namespace fx::base {
class AssetTable;
}

namespace fx::render {

struct FrameKey
{
    RevisionPair revisions;
    /// Moment between the snapshots. If both have equal content, the value is 0, because all moments give the
    /// same frame.
    double interpolation = 0;
    CameraView camera;
    int width = 0, height = 0; ///< [pixel]
    float exposureEv100 = 0;
    Lighting lighting;
    HostLights hostLights;
    SliceSettings slices;
    float particleShare = 1;
    LodSettings lod;
    BlockSettings blocks;
    Composition composition = Composition::Sorted;
    int voxels = 0;
    bool layerOutputs = false;
    uint32_t outputs = 0;
    uint64_t volumeReads = 0; ///< base::VolumeSequence::readsOfAll(): frames that were late may have come
    uint64_t shown = 0;       ///< shownHash()
    const base::AssetTable* assets =
        nullptr; ///< only the address is compared; the pointer is never dereferenced

    bool operator==(const FrameKey&) const = default;
};

/// Hash of the placements at which a frame shows instances; 0 if there are none.
inline uint64_t shownHash(const base::SnapshotPair& snapshots)
{
    uint64_t hash = 0;
    for (const base::ShownPlacement& one : snapshots.shown) {
        hash = base::hashWord(hash, one.instance);
        hash = base::hashBytes(hash, &one.placement.position, sizeof one.placement.position);
        hash = base::hashBytes(hash, &one.placement.rotation, sizeof one.placement.rotation);
        hash = base::hashBytes(hash, &one.placement.scale, sizeof one.placement.scale);
    }
    return hash;
}

inline FrameKey frameKey(const RevisionPair& revisions, uint64_t shown, const FrameRequest& request,
                         const ViewSettings& settings, const base::AssetTable* assets)
{
    FrameKey key;
    key.shown = shown;
    key.revisions = revisions;
    key.interpolation = revisions.isSteady() ? 0.0 : request.interpolation;
    key.camera = request.camera;
    key.width = request.targets.width;
    key.height = request.targets.height;
    key.exposureEv100 = settings.exposureEv100;
    key.lighting = settings.lighting;
    key.hostLights = settings.hostLights;
    key.slices = settings.slices;
    key.particleShare = settings.particleShare;
    key.lod = settings.lod;
    key.blocks = settings.blocks;
    key.composition = settings.composition;
    key.voxels = settings.voxels;
    key.layerOutputs = settings.layerOutputs;
    key.outputs = settings.outputs;
    key.volumeReads = base::VolumeSequence::readsOfAll();
    key.assets = assets;
    return key;
}

} // namespace fx::render
