#include "fxsdk/cli/scene/effect_scene.h"

#include "foundation/assets/volume_sequence.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/particle_kind.h"
#include "foundation/snapshot/volume_kind.h"
#include "fxsdk/api/scene_object.h"
#include "fxsdk/cli/scene/api_status.h"
#include "fxsdk/cli/scene/field_cache.h"
#include "fxsdk/cli/scene/instance_definition.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/techniques.h"
#include "rendering/volumes/volume_place.h"

#include <algorithm>
#include <filesystem>
#include <memory_resource>
#include <string_view>
#include <vector>

namespace fx::cli {
namespace {

/// Copies one group of blobs or lights that the C API hands out.
base::Status copyGroup(FxScene* scene, FxSnapshotId id, FxSnapshotStep step, uint32_t index,
                       const FxSnapshotGroup& source, base::SnapshotGroup& target)
{
    base::GroupInfo& info = target.editInfo();
    info.count = source.count;
    info.instance = source.instance.bits;
    info.solver = source.solver;
    info.placement.position = {source.position[0], source.position[1], source.position[2]};
    info.placement.rotation =
        glm::quat(source.rotation[3], source.rotation[0], source.rotation[1], source.rotation[2]);
    info.placement.scale = source.scale;
    if (source.ids)
        std::copy_n(source.ids, source.count, target.editIds().begin());
    std::copy_n(source.constants, source.constantCount, target.editConstants().begin());
    for (uint32_t c = 0; c < source.columnCount; ++c) {
        FxSnapshotColumn column = {};
        column.structSize = sizeof column;
        const FxResult result = fxScene_GetSnapshotColumn(scene, id, step, index, c, &column);
        if (result != FX_OK)
            return toStatus(result);
        std::copy_n(column.values, column.count, target.editColumn(c).begin());
    }
    return {};
}

/// Media, what they carry for their detail, their voxels, and the lights that they shed; nothing else is
/// shown without a view.
bool isCopied(std::string_view kind)
{
    return kind == base::kBlobKind.name || kind == base::kMaterialKind.name ||
           kind == base::kVolumeKind.name || kind == base::kLightKind.name;
}

base::Status copyGroups(FxScene* scene, FxSnapshotId id, FxSnapshotStep step, const FxSnapshotInfo& info,
                        base::FrameSnapshot& target)
{
    const bool isNewer = step == FX_SNAPSHOT_NEWER;
    target.begin(isNewer ? info.tickNewer : info.tickOlder, 1);
    const uint32_t groups = isNewer ? info.groupsNewer : info.groupsOlder;
    for (uint32_t i = 0; i < groups; ++i) {
        FxSnapshotGroup group = {};
        group.structSize = sizeof group;
        if (FxResult result = fxScene_GetSnapshotGroup(scene, id, step, i, &group); result != FX_OK)
            return toStatus(result);
        const base::KindId kind = target.schema().find(group.kind);
        if (kind == base::kNoKind || !isCopied(group.kind))
            continue;
        if (base::Status status = copyGroup(scene, id, step, i, group, target.addGroup(kind, group.count));
            !status)
            return status;
    }
    return {};
}

/// Adds center and radius of what a group of sprites or meshes shows, in the world.
base::Status addPlaces(FxScene* scene, FxSnapshotId id, uint32_t index, std::vector<glm::vec4>& io)
{
    FxSnapshotGroup group = {};
    group.structSize = sizeof group;
    if (const FxResult result = fxScene_GetSnapshotGroup(scene, id, FX_SNAPSHOT_NEWER, index, &group);
        result != FX_OK)
        return toStatus(result);
    if (group.kind != base::kParticleKind.name)
        return {};
    namespace column = base::particle_column;
    FxSnapshotColumn columns[4] = {};
    const size_t wanted[4] = {column::PositionX, column::PositionY, column::PositionZ, column::Radius};
    for (size_t c = 0; c < 4; ++c) {
        columns[c].structSize = sizeof columns[c];
        if (const FxResult result = fxScene_GetSnapshotColumn(scene, id, FX_SNAPSHOT_NEWER, index,
                                                              uint32_t(wanted[c]), &columns[c]);
            result != FX_OK)
            return toStatus(result);
    }
    const glm::quat turn(group.rotation[3], group.rotation[0], group.rotation[1], group.rotation[2]);
    const glm::vec3 origin(group.position[0], group.position[1], group.position[2]);
    for (uint32_t i = 0; i < group.count; ++i) {
        const glm::vec3 local(columns[0].values[i], columns[1].values[i], columns[2].values[i]);
        if (columns[3].values[i] > 0.0f)
            io.emplace_back(origin + turn * (group.scale * local), group.scale * columns[3].values[i]);
    }
    return {};
}

} // namespace

EffectScene::EffectScene()
{
    preset::registerKinds(schema_);
    copy_ = std::make_unique<base::FrameSnapshot>(&schema_, std::pmr::get_default_resource());
    older_ = std::make_unique<base::FrameSnapshot>(&schema_, std::pmr::get_default_resource());
}

EffectScene::~EffectScene()
{
    fxDestroyScene(scene_);
    fxDestroyContext(context_);
}

base::Result<std::unique_ptr<EffectScene>> EffectScene::create(const scene_file::SceneFile& file,
                                                               const EffectSceneOptions& options)
{
    std::unique_ptr<EffectScene> scene(new EffectScene);
    if (base::Status status = scene->start(file, options); !status)
        return status;
    return scene;
}

base::Status EffectScene::start(const scene_file::SceneFile& file, const EffectSceneOptions& options)
{
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.gl = options.gl;
    compute_ = ComputeOverride(options.compute);
    contextDef.assets = compute_.hook();
    if (base::Status status = toStatus(fxCreateContext(&contextDef, &context_)); !status)
        return status;
    FxSceneDef sceneDef = fxDefaultSceneDef();
    sceneDef.stepTicks = base::kTicksPerSecond / options.stepsPerSecond;
    sceneDef.quality = options.quality;
    sceneDef.workBudget = 0; // pictures show the moment that they are asked for, however long it takes
    step_ = sceneDef.stepTicks;
    if (base::Status status = toStatus(fxCreateScene(context_, &sceneDef, &scene_)); !status)
        return status;
    if (file.meshCollides)
        if (base::Status status = addCollisionMesh(file); !status)
            return status;
    return addInstances(file, options);
}

base::Status EffectScene::addCollisionMesh(const scene_file::SceneFile& file)
{
    sim::TriangleMesh mesh;
    mesh.origin = file.mesh.origin;
    mesh.positions = std::span(file.mesh.positions).subspan(file.mesh.addedVertices());
    std::filesystem::path kept;
    if (!file.meshFile.empty())
        kept = fieldFileOf(file.meshFile, mesh, file.meshCellSize);
    auto field = fieldOf(mesh, file.meshCellSize, kept, *context_->tasks, &context_->memory);
    if (!field)
        return field.status();
    scene_->scene.setCollisionField(std::move(*field));
    return {};
}

base::Status EffectScene::addInstances(const scene_file::SceneFile& file, const EffectSceneOptions& options)
{
    std::vector<FxPresetId> presets;
    for (const scene_file::ScenePreset& preset : file.presets) {
        const auto id = compute_.load(context_, preset);
        if (!id.ok())
            return id.status();
        presets.push_back(*id);
    }
    for (base::AssetId id = 1; id <= assets().size(); ++id)
        hasSequences_ = hasSequences_ || assets().sequence(id) != nullptr;
    uint64_t index = 0;
    for (const scene_file::SceneInstance& instance : file.instances) {
        FxInstanceDef def = instanceDefinition(instance, presets[instance.preset], instance.start);
        def.startTick = base::toTicks(instance.start);
        if (options.seed)
            def.seed = *options.seed + index;
        ++index;
        FxInstanceId id = {};
        if (base::Status status = toStatus(fxScene_CreateInstance(scene_, &def, &id)); !status)
            return status;
        director_.add(instance, id);
        instances_.push_back(id.bits);
    }
    return {};
}

uint32_t EffectScene::numberOf(uint64_t instance) const
{
    const auto found = std::ranges::find(instances_, instance);
    return found == instances_.end() ? 0 : uint32_t(found - instances_.begin()) + 1;
}

base::Status EffectScene::showMoment(base::Ticks tick)
{
    const base::Ticks end = tick + step_;
    while (now_ < end) {
        if (interruptRequested())
            return interruptedStatus();
        const base::Ticks from = now_ / step_ * step_;
        const base::Ticks part = std::min(from + step_, end) - now_;
        if (now_ + part == from + step_) // this takes the step
            if (base::Status status = director_.beforeStep(scene_, from, from + step_); !status)
                return status;
        if (base::Status status = toStatus(fxScene_Update(scene_, base::toSeconds(part))); !status)
            return status;
        now_ += part;
    }
    return {};
}

base::Result<const base::FrameSnapshot*> EffectScene::snapshot()
{
    const auto copied = moment();
    if (!copied.ok())
        return copied.status();
    return static_cast<const base::FrameSnapshot*>(copy_.get());
}

base::Result<SceneMoment> EffectScene::moment()
{
    FxSnapshotId id = {};
    if (base::Status status = toStatus(fxScene_AcquireSnapshot(scene_, &id)); !status)
        return status;
    FxSnapshotInfo info = {};
    info.structSize = sizeof info;
    base::Status copied = toStatus(fxScene_GetSnapshotInfo(scene_, id, &info));
    if (copied.ok())
        copied = copyGroups(scene_, id, FX_SNAPSHOT_NEWER, info, *copy_);
    const bool hasOlder = copied.ok() && info.tickOlder < info.tickNewer;
    if (hasOlder)
        copied = copyGroups(scene_, id, FX_SNAPSHOT_OLDER, info, *older_);
    const base::Status released = toStatus(fxScene_ReleaseSnapshot(scene_, id));
    if (!copied)
        return copied;
    if (!released)
        return released;
    return SceneMoment{{copy_.get(), hasOlder ? older_.get() : nullptr}, info.interpolation};
}

const base::AssetTable& EffectScene::assets() const
{
    return context_->assets;
}

base::VolumeSequence::Counts EffectScene::volumeCounts() const
{
    base::VolumeSequence::Counts sum;
    for (base::AssetId id = 1; hasSequences_ && id <= assets().size(); ++id)
        if (const auto sequence = assets().sequence(id)) {
            const base::VolumeSequence::Counts own = sequence->counts();
            sum.reads += own.reads;
            sum.late += own.late;
            sum.failures += own.failures;
            sum.bytes += own.bytes;
            sum.peakBytes += own.peakBytes;
        }
    return sum;
}

base::Status EffectScene::waitForFrames()
{
    if (!hasSequences_)
        return {};
    const auto shown = moment();
    if (!shown)
        return shown.status();
    const base::FrameSnapshot& newer = *shown->snapshots.newer;
    for (size_t g = 0; g < newer.groupCount(); ++g) {
        const base::SnapshotGroup* const group = render::volumeGroup(newer, g);
        if (!group)
            continue;
        const render::GroupVolume volume = render::groupVolume(
            newer.group(g), *group, {}, shown->snapshots.older ? shown->interpolation : 1.0);
        const auto sequence = assets().sequence(volume.asset);
        if (!sequence)
            continue;
        const render::FramePair pair = render::framePair(volume, sequence->count());
        for (const uint32_t frame : {pair.first, pair.second})
            if (const auto read = sequence->wait(frame); !read)
                return read.status();
        sequence->setWaits(true); // for coarser levels, which only the view knows to be needed
    }
    return {};
}

base::Result<std::vector<glm::vec4>> EffectScene::places()
{
    FxSnapshotId id = {};
    if (base::Status status = toStatus(fxScene_AcquireSnapshot(scene_, &id)); !status)
        return status;
    std::vector<glm::vec4> found;
    FxSnapshotInfo info = {};
    info.structSize = sizeof info;
    base::Status read = toStatus(fxScene_GetSnapshotInfo(scene_, id, &info));
    for (uint32_t i = 0; i < info.groupsNewer && read.ok(); ++i)
        read = addPlaces(scene_, id, i, found);
    const base::Status released = toStatus(fxScene_ReleaseSnapshot(scene_, id));
    if (!read)
        return read;
    if (!released)
        return released;
    return found;
}

base::Result<FxSceneStatistics> EffectScene::statistics() const
{
    FxSceneStatistics statistics = {};
    statistics.structSize = sizeof statistics;
    if (base::Status status = toStatus(fxScene_GetStatistics(scene_, &statistics)); !status)
        return status;
    return statistics;
}

} // namespace fx::cli
