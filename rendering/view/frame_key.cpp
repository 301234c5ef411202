#include "rendering/view/frame_key.h"

namespace fx::render {

FrameKey frameKey(const RevisionPair& revisions, const FrameRequest& request, const ViewSettings& settings,
                  const base::AssetTable* assets)
{
    FrameKey key;
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
    key.composition = settings.composition;
    key.voxels = settings.voxels;
    key.layerOutputs = settings.layerOutputs;
    key.outputs = settings.outputs;
    key.assets = assets;
    return key;
}

} // namespace fx::render
