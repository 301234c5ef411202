/// @file volume_scene.h
/// A medium on voxels that stands still, as a snapshot for views and as blobs for the renderers without a
/// GPU.
///
/// Threads: one at a time.
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "fxsdk/cli/scene/effect_scene.h"
#include "rendering/reference/render/reference_scene.h"
#include "rendering/volumes/medium_volume.h"
#include "rendering/voxelization/medium_grid.h"

#include <memory>

namespace fx::cli {

/// The cloud of LumpyCloud in voxels.
/// @param depth [1] optical depth through the center  @param side [m] of a voxel
/// @return a grid without blocks: the voxels are too many
render::MediumGrid lumpyGrid(double depth, double side, base::TaskRunner& tasks);

class VolumeScene
{
public:
    /// @return errors of AssetTable::addVolume()
    static base::Result<std::unique_ptr<VolumeScene>> create(base::VoxelVolume volume);

    SceneMoment moment() const { return {{&snapshot_, nullptr}, 1.0}; }
    const base::SnapshotSchema& schema() const { return schema_; }
    const base::AssetTable& assets() const { return assets_; }
    /// Scene of the ray integral through the same voxels. The scene refers to this object.
    render::ReferenceScene reference(const render::ReferenceCamera& camera) const;

private:
    VolumeScene();

    base::HostMemory memory_;
    base::AssetTable assets_;
    base::SnapshotSchema schema_;
    base::FrameSnapshot snapshot_;
    std::shared_ptr<const render::MediumVolume> voxels_;
};

} // namespace fx::cli
