/// @file frame_key.h
/// Key of all inputs of a frame's lists. While it does not change, gathered, sorted and uploaded data of the
/// last frame are reused.
#pragma once

#include "rendering/frame/snapshot_revisions.h"
#include "rendering/frame/view_types.h"

namespace fx::base {
class AssetTable;
}

namespace fx::render {

struct FrameKey
{
    RevisionPair revisions;
    double interpolation = 0; ///< 0 where both snapshots hold the same: then no moment differs
    CameraView camera;
    int width = 0, height = 0; ///< [pixel]
    float exposureEv100 = 0;
    Lighting lighting;
    HostLights hostLights;
    SliceSettings slices;
    float particleShare = 1;
    LodSettings lod;
    Composition composition = Composition::Sorted;
    int voxels = 0;
    bool layerOutputs = false;
    uint32_t outputs = 0;
    const base::AssetTable* assets = nullptr; ///< never followed

    bool operator==(const FrameKey&) const = default;
};

FrameKey frameKey(const RevisionPair& revisions, const FrameRequest& request, const ViewSettings& settings,
                  const base::AssetTable* assets);

} // namespace fx::render
