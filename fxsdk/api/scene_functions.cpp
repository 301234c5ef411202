// The functions of fx_scene.h that concern the whole scene.
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace {

using fx::base::Code;
using fx::base::Status;

constexpr int64_t kLongestAbsence = 3600 * FX_TICKS_PER_SECOND;
constexpr uint32_t kAllEvents = FX_EVENTS_FINISHED | FX_EVENTS_CUES | FX_EVENTS_UNNAMED;

/// The default stands for gravity that points down in every world, see FxSceneDef::gravity.
glm::vec3 toGravity(const fx::api::HostWorld& world, const FxSceneDef& def)
{
    const glm::vec3 given = glm::make_vec3(def.gravity);
    const FxSceneDef defaults = fxDefaultSceneDef();
    return given == glm::make_vec3(defaults.gravity) ? given : world.vector(def.gravity);
}

Status checkDef(const fx::api::HostWorld& world, const FxSceneDef& def)
{
    fx::api::Checks check;
    check.range(def.maxInstances, 1u, uint32_t(fx::scene::kIdPartMask), "def.maxInstances");
    check.range(def.stepTicks, FX_TICKS_PER_SECOND / 1000, FX_TICKS_PER_SECOND, "def.stepTicks");
    check.range(def.maxFrameTicks, def.stepTicks, 60 * FX_TICKS_PER_SECOND, "def.maxFrameTicks");
    const glm::vec3 gravity = toGravity(world, def);
    check.range3(glm::value_ptr(gravity), -1000.0f, 1000.0f, "def.gravity in m/s2");
    check.flag(def.hasGround, "def.hasGround");
    check.flag(def.shareInstances, "def.shareInstances");
    check.flag(def.disableCulling, "def.disableCulling");
    check.flag(def.lockStep, "def.lockStep");
    check.range(def.releaseAfterTicks, INT64_C(0), kLongestAbsence, "def.releaseAfterTicks");
    check.range(def.maxCatchUpTicks, INT64_C(0), kLongestAbsence, "def.maxCatchUpTicks");
    check.range(def.catchUpSteps, 1u, UINT32_MAX, "def.catchUpSteps");
    check.range(def.reserved, 0u, 0u, "def.reserved");
    check.range(def.eventCapacity, 0u, 1'000'000u, "def.eventCapacity");
    check.range(def.eventKinds, 0u, kAllEvents, "def.eventKinds");
    fx::api::checkQuality(check, def.quality, "def.quality");
    return check.status();
}

FxSceneStatistics gatherStatistics(FxScene& object)
{
    fx::scene::Scene& scene = object.scene;
    const fx::scene::SceneCounters counters = scene.counters();
    FxSceneStatistics statistics{};
    statistics.instances = counters.instances;
    statistics.instancesDormant = counters.dormant;
    statistics.instancesActive = counters.active;
    statistics.instancesFinished = counters.finished;
    statistics.particles = scene.particles();
    statistics.steps = counters.steps;
    statistics.born = counters.work.born;
    statistics.dropped = counters.work.dropped;
    statistics.particleSteps = counters.work.particleSteps;
    statistics.neighborPairs = counters.work.neighborPairs;
    statistics.clamped = counters.work.clamped;
    statistics.wakeFailures = counters.wakeFailures;
    statistics.refusedUpdates = counters.refusedUpdates;
    statistics.nowTick = scene.clock().now();
    statistics.simulatedTick = scene.clock().simulated();
    statistics.droppedTicks = counters.droppedTicks;
    statistics.updateAllocations = object.updateAllocations;
    statistics.debtTicks = counters.work.debt;
    statistics.subSteps = counters.work.subSteps;
    statistics.simulations = counters.simulations;
    statistics.instancesWaking = counters.waking;
    statistics.instancesResting = counters.resting;
    statistics.instancesHidden = counters.hidden;
    statistics.catchUpsSkipped = counters.catchUpsSkipped;
    statistics.timeDebtTicks = scene.clock().debt();
    statistics.updateWork = scene.lastUpdate().workUnits;
    statistics.eventsLost = scene.lostEvents();
    statistics.eventsPending = scene.eventCount();
    return statistics;
}

} // namespace

void fx::api::destroyScene(FxScene* scene)
{
    FxContext* context = scene->context;
    std::erase(context->scenes, scene);
    std::pmr::polymorphic_allocator<>(&context->memory).delete_object(scene);
}

FxResult fxCreateScene(FxContext* context, const FxSceneDef* def, FxScene** outScene)
{
    return fx::api::guarded("fxCreateScene", fx::api::logOf(context), [&]() -> Status {
        fx::api::Checks check;
        check.notNull(context, "context");
        check.notNull(outScene, "outScene");
        if (!check.status())
            return check.status();
        FxSceneDef known;
        if (Status status = fx::api::readStruct(def, "def", fxDefaultSceneDef(), known); !status)
            return status;
        if (Status status = checkDef(context->world, known); !status)
            return status;

        const fx::api::SharedCaller::Scope scope(context->tables);
        if (!scope.status())
            return scope.status();
        const size_t count = context->scenes.size() + 1;
        if (context->scenes.capacity() < count)
            context->scenes.reserve(std::max(count, 2 * context->scenes.capacity()));
        const fx::scene::SceneOptions options{known.stepTicks,
                                              known.maxFrameTicks,
                                              known.maxInstances,
                                              {toGravity(context->world, known), known.hasGround != 0},
                                              known.shareInstances != 0,
                                              known.disableCulling == 0,
                                              known.lockStep != 0,
                                              known.releaseAfterTicks,
                                              known.maxCatchUpTicks,
                                              known.catchUpSteps,
                                              known.workBudget == 0 ? fx::base::kNoWorkLimit
                                                                    : known.workBudget,
                                              known.eventCapacity,
                                              (known.eventKinds & FX_EVENTS_FINISHED) != 0,
                                              (known.eventKinds & FX_EVENTS_CUES) != 0,
                                              (known.eventKinds & FX_EVENTS_UNNAMED) != 0,
                                              known.reserveLimit};
        FxScene* scene =
            std::pmr::polymorphic_allocator<>(&context->memory).new_object<FxScene>(context, options);
        scene->quality = fx::api::toQuality(known.quality, fx::sim::QualityLevel::Medium);
        scene->maxInstances = known.maxInstances;
        context->scenes.push_back(scene);
        *outScene = scene;
        return {};
    });
}

FxResult fxDestroyScene(FxScene* scene)
{
    return fx::api::guarded("fxDestroyScene", fx::api::logOf(scene), [&]() -> Status {
        if (!scene)
            return {};
        fx::api::SingleCaller::Scope inside(scene->caller, fx::api::kSceneThreadRule);
        if (!inside)
            return inside.status();
        const fx::api::SharedCaller::Scope tables(scene->context->tables);
        if (!tables.status())
            return tables.status();
        if (scene->views.load() != 0)
            return fx::api::invalid("a view still shows the scene; destroy the view first");
        if (scene->held.any())
            return fx::api::invalid("a snapshot of the scene is still held; release it first");
        inside.close();
        fx::api::destroyScene(scene);
        return {};
    });
}

FxResult fxScene_AdoptThread(FxScene* scene)
{
    return fx::api::guarded("fxScene_AdoptThread", fx::api::logOf(scene), [&]() -> Status {
        if (!scene)
            return fx::api::invalid("scene is null");
        if (scene->caller.busy())
            return {Code::ReEntrant, "a call is inside the scene; adopt it when that has returned"};
        scene->caller.thread.adopt();
        return {};
    });
}

namespace {

[[gnu::noinline]] Status contactFault(uint64_t faults) // rare, and far from what every frame passes through
{
    return {
        fx::base::Code::HostAnswer,
        "the contact hook gave " + std::to_string(faults) +
            " answers that are none; needed are a share in 0..1 and a normal that is finite and not zero, "
            "or the return value 0 for a free way"};
}

[[gnu::noinline]] Status refusedTime(double seconds)
{
    return fx::api::invalid("dtSeconds is " + std::to_string(seconds) + "; needed is a time of at least 0 s");
}

/// Notes that an update was asked for more time than it simulates, and says so once.
[[gnu::noinline]] void shorten(FxScene& scene, double seconds, bool isAccepted)
{
    scene.notices.fetch_or(FxScene::kCatchingUp);
    if (!isAccepted || scene.isLongReported)
        return;
    scene.isLongReported = true;
    fx::api::logMessage(*scene.context, FX_LOG_WARNING,
                        ("an update of " + std::to_string(std::min(seconds, 1e9)) + " s was shortened to " +
                         std::to_string(scene.longestFrame) +
                         " s, FxSceneDef::maxFrameTicks: call fxScene_Update more often, or raise it "
                         "(this is said once)")
                            .c_str());
}

[[gnu::noinline]] void heedNotices(FxScene& scene)
{
    if ((scene.notices.exchange(0) & FxScene::kPresetsChanged) != 0)
        scene.followPresets();
}

/// Says when updates begin to leave steps to the next ones.
void reportDebt(FxScene& scene)
{
    const bool isBehind = scene.scene.clock().isBehind();
    if (isBehind && !scene.isBehind)
        fx::api::logMessage(*scene.context, FX_LOG_WARNING,
                            "the steps of a scene need more work than FxSceneDef::workBudget allows an "
                            "update: scene time falls behind, see FxSceneStatistics::timeDebtTicks");
    scene.isBehind = isBehind;
}

} // namespace

FxResult fxScene_Update(FxScene* scene, double dtSeconds)
{
    return fx::api::insideScene("fxScene_Update", scene, [&]() -> Status {
        const uint64_t before = scene->context->memory.allocationCount();
        scene->scene.setGpuParticles(scene->computesOnGpu());
        const bool accepted = scene->scene.update(dtSeconds);
        if (dtSeconds > scene->longestFrame) [[unlikely]]
            shorten(*scene, dtSeconds, accepted);
        else if (scene->notices.load(std::memory_order_relaxed) != 0) [[unlikely]]
            heedNotices(*scene);
        reportDebt(*scene);
        scene->updateAllocations = scene->context->memory.allocationCount() - before;
        if (!accepted)
            return refusedTime(dtSeconds);
        const uint64_t faults = scene->scene.takeContactFaults();
        return faults > 0 ? contactFault(faults) : Status();
    });
}

FxResult fxScene_GetStatistics(FxScene* scene, FxSceneStatistics* ioStatistics)
{
    return fx::api::insideScene("fxScene_GetStatistics", scene, [&]() -> Status {
        return fx::api::writeStruct(gatherStatistics(*scene), ioStatistics, "ioStatistics");
    });
}
