// The functions of fx_snapshot.h.
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/fx_snapshot.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <string_view>

namespace {

using fx::base::Code;
using fx::base::FrameSnapshot;
using fx::base::KindDesc;
using fx::base::SnapshotGroup;
using fx::base::Status;
using fx::scene::Presentation;

/// The functions here may be called from any thread and from callbacks, but not while the scene is destroyed.
Status checkOpen(const FxScene* scene)
{
    if (!scene)
        return fx::api::invalid("scene is null");
    return scene->caller.isClosed() ? Status(Code::ReEntrant, "the scene is being destroyed") : Status();
}

/// Looks the snapshot up and runs body(presentation). From any thread: what is held does not change.
template <class F>
FxResult withSnapshot(const char* function, FxScene* scene, FxSnapshotId id, F&& body)
{
    return fx::api::guarded(function, fx::api::logOf(scene), [&]() -> Status {
        if (Status status = checkOpen(scene); !status)
            return status;
        const auto held = scene->held.find(scene->ids.decode(id.bits, fx::api::kSnapshotIdType));
        if (!held)
            return {Code::StaleId, "snapshot names no snapshot that is held of this scene"};
        return body(*held);
    });
}

const FrameSnapshot* stepOf(const Presentation& presentation, FxSnapshotStep step)
{
    return step == FX_SNAPSHOT_NEWER ? presentation.snapshots.newer : presentation.snapshots.older;
}

/// Runs body(group, its kind) for group `index` of the step.
template <class F>
FxResult withGroup(const char* function, FxScene* scene, FxSnapshotId id, FxSnapshotStep step, uint32_t index,
                   F&& body)
{
    return withSnapshot(function, scene, id, [&](const Presentation& presentation) -> Status {
        if (step != FX_SNAPSHOT_NEWER && step != FX_SNAPSHOT_OLDER)
            return fx::api::invalid("step is neither FX_SNAPSHOT_NEWER nor FX_SNAPSHOT_OLDER");
        const FrameSnapshot* snapshot = stepOf(presentation, step);
        if (!snapshot || index >= snapshot->groupCount())
            return fx::api::invalid("the step has no group of this index");
        const SnapshotGroup& group = snapshot->group(index);
        return body(group, snapshot->schema().kind(group.info().kind));
    });
}

Status describeColumn(const SnapshotGroup& group, const KindDesc& kind, uint32_t index,
                      FxSnapshotColumn* ioColumn)
{
    const fx::base::ColumnDesc& desc = kind.columns[index];
    FxSnapshotColumn column{};
    column.count = group.has(index) ? group.count() : 0;
    column.name = desc.name.data(); // a string literal
    column.unit = desc.unit.data();
    if (group.has(index) && desc.type == fx::base::ColumnType::F32)
        column.values = group.column(index).data();
    if (group.has(index) && desc.type == fx::base::ColumnType::U64)
        column.values64 = group.column64(index).data();
    return fx::api::writeStruct(column, ioColumn, "ioColumn");
}

FxSnapshotGroup describeGroup(const FxScene& scene, const SnapshotGroup& group, const KindDesc& kind)
{
    const fx::base::GroupInfo& info = group.info();
    FxSnapshotGroup out{};
    out.count = info.count;
    out.kind = kind.name.data(); // a string literal
    out.instance.bits = scene.ids.encode(info.instance, fx::api::kInstanceIdType);
    out.solver = info.solver;
    out.scale = info.placement.scale;
    scene.context->world.writePosition(info.placement.position, out.position);
    scene.context->world.writeRotation(info.placement.rotation, out.rotation);
    std::copy_n(glm::value_ptr(info.bounds.min), 3, out.boundsMin);
    std::copy_n(glm::value_ptr(info.bounds.max), 3, out.boundsMax);
    out.ids = kind.hasIds ? group.ids().data() : nullptr;
    out.constants = group.constants().data();
    out.constantCount = uint32_t(group.constants().size());
    out.columnCount = uint32_t(kind.columns.size());
    return out;
}

} // namespace

FxResult fxScene_AcquireSnapshot(FxScene* scene, FxSnapshotId* outSnapshot)
{
    return fx::api::guarded("fxScene_AcquireSnapshot", fx::api::logOf(scene), [&]() -> Status {
        if (Status status = checkOpen(scene); !status)
            return status;
        if (!outSnapshot)
            return fx::api::invalid("outSnapshot is null");
        scene->rowsWanted.store(FxScene::kRemembered);
        const Presentation presentation = scene->scene.acquire();
        fx::scene::LocalId id = 0;
        try {
            id = scene->held.add(presentation, scene->context->world, &scene->context->memory);
        } catch (...) {
            scene->scene.release(presentation.snapshots);
            throw;
        }
        if (id == 0) {
            scene->scene.release(presentation.snapshots);
            return {Code::Capacity, "16 snapshots are held already; release one"};
        }
        outSnapshot->bits = scene->ids.encode(id, fx::api::kSnapshotIdType);
        return {};
    });
}

FxResult fxScene_ReleaseSnapshot(FxScene* scene, FxSnapshotId snapshot)
{
    return fx::api::guarded("fxScene_ReleaseSnapshot", fx::api::logOf(scene), [&]() -> Status {
        if (Status status = checkOpen(scene); !status)
            return status;
        const auto taken = scene->held.take(scene->ids.decode(snapshot.bits, fx::api::kSnapshotIdType));
        if (!taken)
            return {Code::StaleId, "snapshot names no snapshot that is held of this scene"};
        scene->scene.release(*taken);
        return {};
    });
}

FxResult fxScene_GetSnapshotInfo(FxScene* scene, FxSnapshotId snapshot, FxSnapshotInfo* ioInfo)
{
    return withSnapshot("fxScene_GetSnapshotInfo", scene, snapshot, [&](const Presentation& held) -> Status {
        FxSnapshotInfo info{};
        info.groupsNewer = uint32_t(held.snapshots.newer->groupCount());
        info.tickNewer = held.snapshots.newer->tick();
        if (const FrameSnapshot* older = held.snapshots.older) {
            info.groupsOlder = uint32_t(older->groupCount());
            info.tickOlder = older->tick();
        }
        info.interpolation = held.interpolation;
        return fx::api::writeStruct(info, ioInfo, "ioInfo");
    });
}

FxResult fxScene_GetSnapshotGroup(FxScene* scene, FxSnapshotId snapshot, FxSnapshotStep step, uint32_t index,
                                  FxSnapshotGroup* ioGroup)
{
    return withGroup("fxScene_GetSnapshotGroup", scene, snapshot, step, index,
                     [&](const SnapshotGroup& group, const KindDesc& kind) {
                         return fx::api::writeStruct(describeGroup(*scene, group, kind), ioGroup, "ioGroup");
                     });
}

FxResult fxScene_GetSnapshotColumn(FxScene* scene, FxSnapshotId snapshot, FxSnapshotStep step, uint32_t group,
                                   uint32_t column, FxSnapshotColumn* ioColumn)
{
    return withGroup("fxScene_GetSnapshotColumn", scene, snapshot, step, group,
                     [&](const SnapshotGroup& found, const KindDesc& kind) -> Status {
                         if (column >= kind.columns.size())
                             return fx::api::invalid("the group has no column of this index");
                         return describeColumn(found, kind, column, ioColumn);
                     });
}

FxResult fxScene_FindSnapshotColumn(FxScene* scene, FxSnapshotId snapshot, FxSnapshotStep step,
                                    uint32_t group, const char* name, FxSnapshotColumn* ioColumn)
{
    return withGroup("fxScene_FindSnapshotColumn", scene, snapshot, step, group,
                     [&](const SnapshotGroup& found, const KindDesc& kind) -> Status {
                         if (!name)
                             return fx::api::invalid("name is null");
                         for (uint32_t i = 0; i < kind.columns.size(); ++i)
                             if (kind.columns[i].name == std::string_view(name))
                                 return describeColumn(found, kind, i, ioColumn);
                         return {Code::NotFound, "the group has no column \"" + std::string(name) + "\""};
                     });
}
