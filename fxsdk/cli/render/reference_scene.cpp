#include "fxsdk/cli/render/reference_scene.h"

#include "foundation/assets/asset_table.h"
#include "foundation/assets/volume_sequence.h"
#include "foundation/snapshot/blob_kind.h"
#include "rendering/techniques/draw_techniques.h"

#include <cmath>
#include <numbers>

namespace fx::cli {
namespace {

constexpr size_t kMaxLights = 64; // of effects, the brightest

render::OpaqueScene opaqueOf(const scene_file::SceneFile& file)
{
    render::OpaqueScene scene;
    scene.mesh = {file.mesh.origin, file.mesh.positions, file.mesh.normals, file.mesh.colors,
                  file.mesh.isSoil};
    const render::StageBackground& b = file.background;
    scene.background = {b.luminance, b.horizon, b.width, b.height, b.image, b.panorama, b.hasHills};
    scene.lighting = file.view.lighting;
    scene.lamps = file.lights;
    return scene;
}

/// What draws no blobs, which are the medium of both renderers.
std::vector<const render::DrawTechnique*> techniquesWithoutMedium()
{
    std::vector<const render::DrawTechnique*> techniques;
    for (const render::DrawTechnique* technique : render::drawTechniques())
        if (technique->kind != &base::kBlobKind)
            techniques.push_back(technique);
    return techniques;
}

std::vector<render::EffectLight> lightsOf(const base::FrameSnapshot& snapshot,
                                          render::DrawTechniques techniques)
{
    std::vector<render::EffectLight> lights(kMaxLights);
    lights.resize(render::effectLights(snapshot, lights, techniques));
    return lights;
}

} // namespace

render::ReferenceCamera cameraOf(const scene_file::CameraPath& path, double time)
{
    const scene_file::CameraPose pose = path.at(time);
    auto camera = render::ReferenceCamera::lookAt(pose.position, pose.target, glm::dvec3(path.up));
    camera.orthographic = path.orthographicHeight > 0.0f;
    camera.halfHeight = camera.orthographic ? 0.5 * double(path.orthographicHeight)
                                            : std::tan(double(path.fovYDegrees) * std::numbers::pi / 360.0);
    camera.nearDistance = double(path.nearPlane);
    return camera;
}

base::Result<std::unique_ptr<ReferenceSceneSource>>
ReferenceSceneSource::create(const scene_file::SceneFile& file, const EffectSceneOptions& options)
{
    std::unique_ptr<ReferenceSceneSource> source(new ReferenceSceneSource(file));
    auto effects = EffectScene::create(file, options);
    if (!effects.ok())
        return effects.status();
    source->effects_ = std::move(*effects);
    return source;
}

std::shared_ptr<const render::MediumVolume> ReferenceSceneSource::keep(uint32_t asset, uint32_t frame,
                                                                       const base::VoxelVolume& voxels)
{
    std::shared_ptr<const render::MediumVolume>& held = volumes_[{asset, frame}];
    if (!held)
        held = std::make_shared<const render::MediumVolume>(voxels);
    return held;
}

std::shared_ptr<const render::MediumVolume> ReferenceSceneSource::volumeOf(const render::GroupVolume& volume,
                                                                           base::Status& ioStatus)
{
    const base::AssetTable& assets = effects_->assets();
    const auto sequence = assets.sequence(volume.asset);
    if (!sequence) {
        const auto voxels = assets.volume(volume.asset);
        return voxels ? keep(volume.asset, 0, *voxels) : nullptr;
    }
    const render::FramePair pair = render::framePair(volume, sequence->count());
    std::erase_if(volumes_, [&](const auto& known) {
        return known.first.first == volume.asset && known.first.second != pair.first &&
               known.first.second != pair.second;
    });
    std::shared_ptr<const render::MediumVolume> ends[2];
    for (const int k : {0, 1}) {
        const uint32_t frame = k == 0 ? pair.first : pair.second;
        const auto voxels = sequence->wait(frame);
        if (!voxels) {
            ioStatus = voxels.status();
            return nullptr;
        }
        ends[k] = keep(volume.asset, frame, **voxels);
    }
    const render::MediumVolume::Moment moment = render::momentOf(volume, pair, *sequence);
    if (pair.first == pair.second && moment.toFirst.isSame())
        return ends[0];
    return std::make_shared<const render::MediumVolume>(
        render::MediumVolume::between(*ends[0], *ends[1], moment));
}

base::Result<ReferenceFrame> ReferenceSceneSource::frameAt(base::Ticks tick)
{
    if (base::Status status = effects_->showMoment(tick); !status)
        return status;
    const auto moment = effects_->moment();
    if (!moment.ok())
        return moment.status();
    ReferenceFrame frame;
    base::Status read;
    render::MediumList medium =
        render::mediumOf(moment->snapshots, moment->interpolation,
                         [&](const render::GroupVolume& volume) { return volumeOf(volume, read); });
    if (!read)
        return read;
    frame.scene.blobs = std::move(medium.blobs);
    frame.scene.details = std::move(medium.details);
    for (render::MediumBlob& blob : frame.scene.blobs)
        blob.instance = effects_->numberOf(blob.instance);
    frame.nonFinite = medium.nonFinite;
    frame.scene.opaque = opaqueOf(file_);
    frame.scene.camera = cameraOf(file_.camera, base::toSeconds(tick));
    if (moment->snapshots.newer) {
        const base::FrameSnapshot& newer = *moment->snapshots.newer;
        frame.scene.opaque.lights = lightsOf(newer, render::drawTechniques());
        frame.scene.opaque.particleLights = lightsOf(newer, techniquesWithoutMedium());
    }
    return frame;
}

} // namespace fx::cli
