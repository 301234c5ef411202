#include "benchmarks/scenes/volume_scene.h"

#include "benchmarks/scenes/lumpy_cloud.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/volume_kind.h"
#include "rendering/reference/render/medium_blobs.h"
#include "rendering/volumes/volume_levels.h"
#include "rendering/voxelization/ball_voxelizer.h"
#include "simulation/volume/volume_solver.h"

namespace fx::cli {

namespace {

constexpr uint64_t kMostVoxels = uint64_t(1) << 24;

} // namespace

render::MediumGrid lumpyGrid(double depth, double side, base::TaskRunner& tasks)
{
    const LumpyCloud cloud(depth, CloudLight::Front, 8);
    std::vector<render::VoxelBall> balls;
    for (const render::MediumBlob& blob : cloud.blobs()) {
        render::VoxelBall& ball = balls.emplace_back();
        ball.center = blob.center;
        ball.radius = blob.radius;
        ball.crossSection = blob.crossSection;
    }
    render::MediumGrid grid;
    grid.axes = glm::dmat3(side);
    const auto plan = render::BlockPlan::create(balls, side, kMostVoxels);
    if (!plan)
        return grid;
    std::vector<render::VoxelBlock> blocks;
    render::BallVoxelizer(balls, *plan, tasks).fill(0, plan->blocks().size(), blocks);
    for (const render::VoxelBlock& block : blocks) {
        grid.blocks.push_back(block.origin);
        grid.density.insert(grid.density.end(), block.density.begin(), block.density.end());
    }
    return grid;
}

VolumeScene::VolumeScene() : assets_(&memory_), snapshot_(&schema_, &memory_)
{
    for (const base::KindDesc* kind : {&base::kBlobKind, &base::kVolumeKind})
        static_cast<void>(schema_.add(*kind));
}

base::Result<std::unique_ptr<VolumeScene>> VolumeScene::create(base::VoxelVolume volume)
{
    std::unique_ptr<VolumeScene> scene(new VolumeScene());
    sim::VolumeDef def;
    def.voxels = std::make_shared<const base::VoxelVolume>(std::move(volume));
    def.cells = base::volumeCells(*def.voxels);
    const base::Result<base::AssetId> asset =
        scene->assets_.addVolume(def.voxels, 1, render::coarserLevels(*def.voxels));
    if (!asset)
        return asset.status();
    def.asset = *asset;
    scene->voxels_ = std::make_shared<const render::MediumVolume>(*def.voxels);
    scene->snapshot_.begin(0, 1);
    base::GroupInfo info;
    info.instance = 1;
    def.create(scene->schema_, {}, &scene->memory_)->publish(info, scene->snapshot_);
    return scene;
}

render::ReferenceScene VolumeScene::reference(const render::ReferenceCamera& camera) const
{
    render::MediumList medium =
        render::mediumOf({&snapshot_, nullptr}, 1.0, [&](const render::GroupVolume&) { return voxels_; });
    render::ReferenceScene scene;
    scene.blobs = std::move(medium.blobs);
    scene.details = std::move(medium.details);
    scene.opaque.isEmpty = true;
    scene.camera = camera;
    return scene;
}

} // namespace fx::cli
