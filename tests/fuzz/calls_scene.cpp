#include "tests/fuzz/calls_player.h"

#include <algorithm>
#include <cmath>

namespace fx::fuzz {

namespace {

constexpr uint32_t kMaxInstances = 12;      ///< of a scene, so that recordings stay short
constexpr double kLongestUpdate = 4.0 / 60; ///< [s]
constexpr double kLongestSeek = 1.5;        ///< [s]

/// A floor, half transparent to ways whose length is odd: answers depend on the question alone.
int meetFloor(void* user, const double from[3], const double to[3], float* outShare, float outNormal[3])
{
    if (to[1] > 0.0 || from[1] <= 0.0)
        return 0;
    *outShare = float(from[1] / (from[1] - to[1]));
    outNormal[0] = outNormal[2] = 0.0f;
    outNormal[1] = user ? 1.0f : 0.0f; // without a user the answer is none
    return 1;
}

} // namespace

std::span<const CallsPlayer::Call> CallsPlayer::callsOfScenes()
{
    static constexpr std::array<Call, 17> kCalls{
        &CallsPlayer::createScene,      &CallsPlayer::createInstance, &CallsPlayer::updateScene,
        &CallsPlayer::changeInstance,   &CallsPlayer::seekInstance,   &CallsPlayer::triggerEvent,
        &CallsPlayer::setCollisionMesh, &CallsPlayer::setContactHook, &CallsPlayer::setFocus,
        &CallsPlayer::setActivation,    &CallsPlayer::readScene,      &CallsPlayer::saveAndRestore,
        &CallsPlayer::takeSnapshot,     &CallsPlayer::readSnapshot,   &CallsPlayer::releaseSnapshot,
        &CallsPlayer::destroyInstance,  &CallsPlayer::destroyScene};
    return kCalls;
}

void CallsPlayer::createScene()
{
    PlayedContext& played = anyContext();
    PlayedScene& slot = sceneOf(played);
    if (slot.scene)
        return;
    FxSceneDef def = fxDefaultSceneDef();
    def.structSize = structSize(sizeof def);
    if (input_.one(2)) {
        def.maxInstances = 1 + input_.below(20);
        def.hasGround = input_.below(2);
        def.quality = input_.below(6);
        def.shareInstances = input_.below(2);
        def.disableCulling = input_.below(2);
        def.lockStep = input_.below(2);
        def.releaseAfterTicks = int64_t(input_.below(3)) * FX_TICKS_PER_SECOND / 10;
        def.maxCatchUpTicks = int64_t(input_.below(3)) * FX_TICKS_PER_SECOND / 10;
        def.catchUpSteps = 1 + input_.below(200);
        def.gravity[1] = floatNumber(20.0);
        def.eventCapacity = input_.below(100);
        def.eventKinds = input_.below(10);
    }
    FxScene* made = nullptr;
    const FxResult result = checked(fxCreateScene(played.context, &def, &made));
    require((result == FX_OK) == (made != nullptr), "only a created scene is handed out");
    if (made && slot.scene) // a callback has made one
        checked(fxDestroyScene(made));
    else if (made)
        slot.scene = made;
}

void CallsPlayer::destroyScene()
{
    PlayedScene& slot = anyScene();
    FxScene* const scene = slot.scene;
    if (checked(fxDestroyScene(scene)) == FX_OK && slot.scene == scene)
        slot = {};
}

void CallsPlayer::createInstance()
{
    PlayedContext& played = anyContext();
    PlayedScene& slot = sceneOf(played);
    FxInstanceDef def = fxDefaultInstanceDef();
    def.structSize = structSize(sizeof def);
    def.preset = anyPreset(played);
    for (double& x : def.position)
        x = number(5.0);
    def.startTick = int64_t(input_.below(3)) * FX_TICKS_PER_SECOND / 20;
    def.seed = input_.below(3);
    if (input_.one(3)) {
        def.scale = floatNumber(3.0);
        def.intensity = floatNumber(2.0);
        def.wind[0] = floatNumber(10.0);
        def.rotation[1] = floatNumber(1.0);
        def.emitting = input_.below(3);
        def.destroyWhenFinished = input_.below(2);
        def.quality = input_.below(3);
    }
    if (slot.instances.size() >= kMaxInstances)
        return;
    FxInstanceId id{};
    const FxResult result = checked(fxScene_CreateInstance(slot.scene, &def, &id));
    require((result == FX_OK) == (id.bits != 0), "only a created instance has an id");
    if (result == FX_OK)
        slot.instances.push_back(id);
}

void CallsPlayer::destroyInstance()
{
    PlayedScene& slot = anyScene();
    const FxInstanceId id = anyInstance(slot);
    if (checked(fxScene_DestroyInstance(slot.scene, id)) == FX_OK)
        require(fxScene_IsValid(slot.scene, id) == 0, "the id of a destroyed instance is stale");
}

void CallsPlayer::updateScene()
{
    PlayedScene& slot = anyScene();
    checked(fxScene_Update(slot.scene, 1.0 / 60 + number(kLongestUpdate)));
}

void CallsPlayer::changeInstance()
{
    PlayedScene& slot = anyScene();
    const FxInstanceId id = anyInstance(slot);
    const double position[3] = {number(5.0), number(5.0), number(5.0)};
    const float angle = floatNumber(1.0);
    const float rotation[4] = {0.0f, angle, 0.0f,
                               input_.one(8) ? 1.0f : std::sqrt(std::max(0.0f, 1.0f - angle * angle))};
    FxInstanceParameters parameters = fxDefaultInstanceParameters();
    parameters.structSize = structSize(sizeof parameters);
    parameters.intensity = floatNumber(2.0);
    parameters.wind[0] = floatNumber(10.0);
    parameters.emitting = input_.below(3);
    switch (input_.below(3)) {
    case 0:
        checked(fxScene_SetTransform(slot.scene, id, position, rotation, floatNumber(3.0)));
        break;
    case 1:
        checked(fxScene_SetParameters(slot.scene, id, &parameters));
        break;
    default:
        checked(fxScene_SetInstanceSpeed(slot.scene, id, floatNumber(4.0)));
        break;
    }
}

void CallsPlayer::seekInstance()
{
    PlayedScene& slot = anyScene();
    double seconds = number(kLongestSeek);
    if (seconds > kLongestSeek && seconds <= 86400.0)
        seconds = kLongestSeek; // each step is taken again
    checked(fxScene_SeekInstance(slot.scene, anyInstance(slot), seconds));
}

void CallsPlayer::triggerEvent()
{
    PlayedScene& slot = anyScene();
    constexpr std::array<const char*, 3> kNames{"burst", "nothing", nullptr};
    checked(fxScene_TriggerEvent(slot.scene, anyInstance(slot), kNames[input_.below(3)], input_.byte()));
}

void CallsPlayer::setCollisionMesh()
{
    PlayedScene& slot = anyScene();
    std::array<float, 18> positions;
    for (float& x : positions)
        x = floatNumber(2.0);
    std::array<uint32_t, 6> indices;
    for (uint32_t& index : indices)
        index = input_.below(7);
    FxCollisionMesh mesh = fxDefaultCollisionMesh();
    mesh.structSize = structSize(sizeof mesh);
    mesh.cellSize = 0.25f + float(input_.below(4)); // 0 would make four million cells
    mesh.positions = input_.one(16) ? nullptr : positions.data();
    mesh.vertexCount = input_.below(7);
    if (input_.one(2)) {
        mesh.indices = indices.data();
        mesh.indexCount = input_.below(7);
    }
    const bool isTiny =
        std::all_of(positions.begin(), positions.end(), [](float x) { return std::abs(x) <= 8.0f; });
    if (isTiny)
        checked(fxScene_SetCollisionMesh(slot.scene, input_.one(4) ? nullptr : &mesh));
}

void CallsPlayer::setContactHook()
{
    PlayedScene& slot = anyScene();
    FxContactHook hook = fxDefaultContactHook();
    hook.structSize = structSize(sizeof hook);
    hook.meet = input_.one(8) ? nullptr : &meetFloor;
    hook.user = input_.one(4) ? nullptr : this;
    checked(fxScene_SetContactHook(slot.scene, input_.one(4) ? nullptr : &hook));
}

void CallsPlayer::setFocus()
{
    PlayedScene& slot = anyScene();
    std::array<FxFocus, 2> foci;
    for (FxFocus& focus : foci) {
        focus = fxDefaultFocus();
        focus.projection[0] = focus.projection[5] = floatNumber(2.0);
        focus.projection[10] = floatNumber(1.0);
        focus.projection[11] = -1.0f;
        focus.origin[2] = number(20.0);
        focus.maxDistance = number(30.0);
        focus.minPixels = floatNumber(4.0);
    }
    foci[0].structSize = structSize(sizeof(FxFocus));
    checked(fxScene_SetFocus(slot.scene, foci.data(), input_.below(3)));
}

void CallsPlayer::setActivation()
{
    PlayedScene& slot = anyScene();
    FxActivationHints hints = fxDefaultActivationHints();
    hints.structSize = structSize(sizeof hints);
    hints.priority = floatNumber(2.0);
    hints.occluded = input_.below(3);
    hints.maxDistance = floatNumber(20.0);
    checked(fxScene_SetActivationHints(slot.scene, anyInstance(slot), &hints));
    FxBudget budget = fxDefaultBudget();
    budget.structSize = structSize(sizeof budget);
    budget.particles = input_.byte();
    budget.bytes = input_.value<uint16_t>();
    checked(fxScene_SetBudget(slot.scene, &budget));
}

void CallsPlayer::readScene()
{
    PlayedScene& slot = anyScene();
    const FxInstanceId id = anyInstance(slot);
    FxSceneStatistics statistics = sized<FxSceneStatistics>();
    if (checked(fxScene_GetStatistics(slot.scene, &statistics)) == FX_OK)
        require(statistics.instances == statistics.instancesDormant + statistics.instancesActive +
                                            statistics.instancesFinished + statistics.instancesWaking +
                                            statistics.instancesResting + statistics.instancesHidden,
                "every instance is in one state");
    FxFrameStats frame = sized<FxFrameStats>();
    checked(fxScene_GetFrameStats(slot.scene, &frame));
    FxInstanceActivity activity = sized<FxInstanceActivity>();
    checked(fxScene_GetInstanceActivity(slot.scene, id, &activity));
    FxInstanceState state = FX_INSTANCE_DORMANT;
    uint32_t particles = 0;
    checked(fxScene_GetInstanceState(slot.scene, id, &state, &particles));
    uint64_t first = 0, second = 0;
    if (checked(fxScene_GetStateHash(slot.scene, &first)) == FX_OK && intruders_ == 0)
        if (checked(fxScene_GetStateHash(slot.scene, &second)) == FX_OK)
            require(first == second, "to look at a state does not change it");
    checked(fxScene_GetSimulationHash(slot.scene, &first));
    std::array<FxInstanceId, 8> ids;
    uint32_t count = 0;
    checked(
        fxScene_GetInstances(slot.scene, input_.one(2) ? ids.data() : nullptr, uint32_t(ids.size()), &count));
    std::array<FxEvent, 6> events{};
    events[0].structSize = structSize(sizeof(FxEvent));
    uint64_t lost = 0, userData = 0;
    if (checked(fxScene_GetEvents(slot.scene, input_.one(4) ? nullptr : events.data(),
                                  events[0].structSize <= sizeof(FxEvent) ? uint32_t(events.size()) : 0,
                                  &count, &lost)) == FX_OK)
        require(count <= 100, "a scene has no more events than its definition allows");
    checked(fxScene_GetUserData(slot.scene, id, &userData));
}

/// Saves one scene and restores another, or the same, from the bytes.
void CallsPlayer::saveAndRestore()
{
    PlayedScene& from = anyScene();
    PlayedScene& to = input_.one(2) ? from : anyScene();
    size_t size = 0;
    if (checked(fxScene_SaveState(from.scene, nullptr, 0, &size)) != FX_OK)
        return;
    std::vector<std::byte> state(size);
    if (checked(fxScene_SaveState(from.scene, state.data(), size, &size)) != FX_OK || size > state.size())
        return;
    if (input_.one(4) && size > 0)
        state[input_.value<uint16_t>() % size] ^= std::byte(1);
    checked(fxScene_RestoreState(to.scene, state.data(), size));
}

void CallsPlayer::takeSnapshot()
{
    PlayedScene& slot = anyScene();
    FxSnapshotId id{};
    const FxResult result = checked(fxScene_AcquireSnapshot(slot.scene, &id));
    require((result == FX_OK) == (id.bits != 0), "only an acquired snapshot has an id");
    if (result == FX_OK)
        slot.snapshots.push_back(id);
}

void CallsPlayer::readSnapshot()
{
    PlayedScene& slot = anyScene();
    const FxSnapshotId id = anySnapshot(slot);
    const auto step = FxSnapshotStep(input_.below(3));
    FxSnapshotInfo info = sized<FxSnapshotInfo>();
    checked(fxScene_GetSnapshotInfo(slot.scene, id, &info));
    FxSnapshotGroup group = sized<FxSnapshotGroup>();
    const uint32_t index = input_.below(4);
    if (checked(fxScene_GetSnapshotGroup(slot.scene, id, step, index, &group)) != FX_OK)
        return;
    for (uint32_t column = 0; column <= group.columnCount; ++column) {
        FxSnapshotColumn values{};
        values.structSize = sizeof values;
        if (checked(fxScene_GetSnapshotColumn(slot.scene, id, step, index, column, &values)) == FX_OK &&
            values.values)
            for (uint32_t i = 0; i < values.count; ++i)
                require(values.values[i] == values.values[i], "snapshots hold no value that is not a number",
                        values.name);
    }
    FxSnapshotColumn named = sized<FxSnapshotColumn>();
    checked(fxScene_FindSnapshotColumn(slot.scene, id, step, index, input_.one(3) ? "nothing" : "radius",
                                       &named));
}

void CallsPlayer::releaseSnapshot()
{
    PlayedScene& slot = anyScene();
    checked(fxScene_ReleaseSnapshot(slot.scene, anySnapshot(slot)));
}

} // namespace fx::fuzz
