// An update does no more work than it is granted; what is left is done later, with the same results.
#include "tests/api/budget_host.h"

#include <utility>

using namespace fx::test;

namespace {

/// Six emitters in eight sub-steps, which take several updates of kBusyBudget.
std::string busyPreset()
{
    std::string list;
    for (int i = 0; i < 6; ++i)
        list += std::string(i > 0 ? "," : "") + R"({"name":"e)" + std::to_string(i) +
                R"(","maxParticles":2000,"lifetime":0.3,"radius":0.1,"emission":{"rate":20000},
                   "forces":{"curlStrength":1,"curlOctaves":4,"drag":1}})";
    return R"({"version":1,"duration":20,"subSteps":8,"emitters":[)" + list + "]}";
}

constexpr uint64_t kBusyBudget = 60'000; ///< [unit]

} // namespace

namespace {

/// Motion that has no closed form, with two seconds of past, in each of which it is 600 steps of its
/// particles.
std::string swirlPreset(double prewarm)
{
    return R"({"version":1,"duration":60,"prewarm":)" + std::to_string(prewarm) +
           R"(,"emitters":[{"name":"e","maxParticles":300,"lifetime":1,"radius":0.1,"emission":{"rate":250},
               "forces":{"curlStrength":1,"curlOctaves":2,"drag":1}}]})";
}

} // namespace

TEST(WorkBudget, prewarmIsSpreadOverUpdatesWhileTheSceneGoesOn)
{
    Host free(0), bounded(20'000);
    FxInstanceId late = {};
    for (Host* const host : {&free, &bounded}) {
        host->add(swirlPreset(0), 1);
        late = host->add(swirlPreset(4), 2);
    }
    int waking = 0;
    for (int i = 0; i < 400 && (i < 5 || bounded.stateOf(late) == FX_INSTANCE_WAKING); ++i) {
        waking += bounded.stateOf(late) == FX_INSTANCE_WAKING ? 1 : 0;
        free.update(kFrame);
        const FxSceneStatistics statistics = bounded.update(kFrame);
        EXPECT_EQ(statistics.timeDebtTicks, 0) << "the others wait for it";
        EXPECT_LE(statistics.updateWork, 20'000u + 300 * 40);
    }
    EXPECT_GT(waking, 3);
    EXPECT_EQ(bounded.stateOf(late), FX_INSTANCE_ACTIVE);
    EXPECT_EQ(simulationHashOf(bounded.scene()), simulationHashOf(free.scene()));
    free.update(kFrame);
    bounded.update(kFrame);
    EXPECT_EQ(hashOf(bounded.scene()), hashOf(free.scene()));
}

TEST(WorkBudget, hashesAndStatesCountAPastThatIsNotSimulatedYet)
{
    Host free(0), bounded(5'000);
    for (Host* const host : {&free, &bounded})
        host->add(swirlPreset(3));
    free.update(kFrame);
    bounded.update(kFrame);
    EXPECT_EQ(statisticsOf(bounded.scene()).instancesWaking, 1u);
    EXPECT_EQ(simulationHashOf(bounded.scene()), simulationHashOf(free.scene()));
}

TEST(WorkBudget, seekingFarIsSpreadOverUpdates)
{
    Host free(0), bounded(20'000);
    const FxInstanceId there = free.add(swirlPreset(0)), id = bounded.add(swirlPreset(0));
    for (Host* const host : {&free, &bounded}) {
        host->update(kFrame);
        ASSERT_EQ(fxScene_SeekInstance(host->scene(), host == &free ? there : id, 5.0), FX_OK);
    }
    EXPECT_EQ(bounded.stateOf(id), FX_INSTANCE_WAKING);
    EXPECT_EQ(free.stateOf(there), FX_INSTANCE_ACTIVE);
    for (int i = 0; i < 400 && (i < 2 || bounded.stateOf(id) == FX_INSTANCE_WAKING); ++i) {
        free.update(kFrame);
        EXPECT_LE(bounded.update(kFrame).updateWork, 20'000u + 300 * 40);
    }
    EXPECT_EQ(bounded.stateOf(id), FX_INSTANCE_ACTIVE);
    EXPECT_EQ(simulationHashOf(bounded.scene()), simulationHashOf(free.scene()));
}

TEST(WorkBudget, whatTheHostDoesWhileAStepIsInHandHoldsFromItsEndOn)
{
    Host one(kBusyBudget, 1), two(kBusyBudget, 2);
    uint64_t hashes[2] = {};
    for (int h = 0; h < 2; ++h) {
        Host& host = h == 0 ? one : two;
        const FxInstanceId first = host.add(busyPreset(), 1), second = host.add(busyPreset(), 2);
        ASSERT_GT(host.update(kFrame).timeDebtTicks, 0);
        const double position[3] = {1, 2, 3};
        const float rotation[4] = {0, 0, 0, 1};
        EXPECT_EQ(fxScene_SetTransform(host.scene(), first, position, rotation, 1.0f), FX_OK);
        FxInstanceParameters parameters = fxDefaultInstanceParameters();
        parameters.intensity = 0.5f;
        parameters.wind[0] = 3.0f;
        EXPECT_EQ(fxScene_SetParameters(host.scene(), first, &parameters), FX_OK);
        EXPECT_EQ(fxScene_SetInstanceSpeed(host.scene(), first, 2.0f), FX_OK);
        EXPECT_EQ(fxScene_DestroyInstance(host.scene(), second), FX_OK);
        EXPECT_EQ(fxScene_DestroyInstance(host.scene(), second), FX_ERROR_STALE_ID);
        const FxInstanceId third = host.add(busyPreset(), 3);
        EXPECT_EQ(host.stateOf(third), FX_INSTANCE_DORMANT);
        EXPECT_EQ(fxScene_SeekInstance(host.scene(), first, 0.1), FX_OK);
        for (int i = 0; i < 6; ++i)
            host.update(kFrame);
        host.payDebt();
        EXPECT_EQ(host.stateOf(third), FX_INSTANCE_ACTIVE);
        EXPECT_EQ(statisticsOf(host.scene()).instances, 2u);
        hashes[h] = simulationHashOf(host.scene());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(WorkBudget, aStepInHandIsCompleteBeforeAStateIsSaved)
{
    Host host(kBusyBudget), other(0), free(0);
    host.add(busyPreset());
    free.add(busyPreset());
    ASSERT_GT(host.update(kFrame).timeDebtTicks, 0);
    size_t size = 0;
    ASSERT_EQ(fxScene_SaveState(host.scene(), nullptr, 0, &size), FX_OK);
    std::vector<std::byte> state(size);
    ASSERT_EQ(fxScene_SaveState(host.scene(), state.data(), size, &size), FX_OK);
    EXPECT_EQ(statisticsOf(host.scene()).timeDebtTicks, 0);
    other.add(busyPreset()); // so that the preset is known
    ASSERT_EQ(fxScene_RestoreState(other.scene(), state.data(), size), FX_OK);
    free.update(kFrame);
    EXPECT_EQ(simulationHashOf(host.scene()), simulationHashOf(free.scene()));
    for (int i = 0; i < 3; ++i) {
        host.update(kFrame);
        free.update(kFrame);
        other.update(kFrame);
    }
    host.payDebt();
    EXPECT_EQ(hashOf(host.scene()), hashOf(free.scene()));
    EXPECT_EQ(hashOf(other.scene()), hashOf(free.scene()));
}

namespace {

/// An emitter so large that a budget of 30'000 shows it in several updates, and does little else.
std::string largePreset()
{
    return R"({"version":1,"duration":60,"emitters":[{"name":"e","maxParticles":20000,"lifetime":20,
               "radius":0.1,"emission":{"bursts":[{"time":0,"count":20000}]}}]})";
}

/// Scene time of the newest snapshot.
int64_t newestOf(FxScene* scene)
{
    FxSnapshotId snapshot{};
    EXPECT_EQ(fxScene_AcquireSnapshot(scene, &snapshot), FX_OK);
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(fxScene_GetSnapshotInfo(scene, snapshot, &info), FX_OK);
    EXPECT_EQ(fxScene_ReleaseSnapshot(scene, snapshot), FX_OK);
    return info.tickNewer;
}

} // namespace

TEST(WorkBudget, readersKeepTheLastCompleteSnapshotWhileTheNextIsWritten)
{
    Host host(30'000);
    host.add(largePreset());
    int waited = 0;
    int64_t before = 0;
    for (int i = 0; i < 60; ++i) {
        const FxSceneStatistics statistics = host.update(kFrame);
        const int64_t newest = newestOf(host.scene());
        EXPECT_EQ(newest, statistics.simulatedTick) << "what is shown is complete";
        waited += newest == before ? 1 : 0;
        before = newest;
    }
    EXPECT_GT(waited, 30);
    EXPECT_GT(before, 0);
}

TEST(WorkBudget, whatTheHostDoesWhileAStepIsPublishedHoldsFromTheNextOn)
{
    Host host(30'000), free(0);
    const FxInstanceId id = host.add(largePreset()), other = host.add(largePreset());
    free.add(largePreset());
    free.add(largePreset());
    int updates = 0;
    while (host.update(updates == 0 ? kFrame : 0.0).timeDebtTicks > 0 && ++updates < 6) {
    }
    ASSERT_EQ(updates, 6) << "births take four updates, publication takes more";
    const double position[3] = {1, 2, 3};
    const float rotation[4] = {0, 0, 0, 1};
    EXPECT_EQ(fxScene_SetTransform(host.scene(), id, position, rotation, 1.0f), FX_OK);
    EXPECT_EQ(fxScene_SeekInstance(host.scene(), other, 1.0), FX_OK);
    EXPECT_EQ(fxScene_DestroyInstance(host.scene(), other), FX_OK);
    while (host.update(0.0).timeDebtTicks > 0) {
    }
    free.update(kFrame);
    EXPECT_EQ(hashOf(host.scene()), hashOf(free.scene())) << "the step is shown as it began";
    host.update(kFrame);
    host.payDebt();
    EXPECT_EQ(statisticsOf(host.scene()).instances, 1u);
    Host after(0);
    FxInstanceId moved = after.add(largePreset());
    after.update(kFrame);
    EXPECT_EQ(fxScene_SetTransform(after.scene(), moved, position, rotation, 1.0f), FX_OK);
    after.update(kFrame);
    EXPECT_EQ(hashOf(host.scene()), hashOf(after.scene()));
}

TEST(WorkBudget, aStepThatIsPublishedIsCompleteBeforeAStateIsSavedOrRestored)
{
    Host host(30'000), free(0);
    for (Host* const each : {&host, &free})
        each->add(largePreset());
    free.update(kFrame);
    host.update(kFrame);
    for (int i = 0; i < 3; ++i)
        ASSERT_GT(host.update(0.0).timeDebtTicks, 0);
    EXPECT_EQ(simulationHashOf(host.scene()), simulationHashOf(free.scene()));
    EXPECT_EQ(statisticsOf(host.scene()).timeDebtTicks, 0);
    EXPECT_EQ(hashOf(host.scene()), hashOf(free.scene()));
    size_t size = 0;
    ASSERT_EQ(fxScene_SaveState(host.scene(), nullptr, 0, &size), FX_OK);
    std::vector<std::byte> state(size);
    ASSERT_EQ(fxScene_SaveState(host.scene(), state.data(), size, &size), FX_OK);
    host.update(kFrame); // the next is in hand
    ASSERT_GT(statisticsOf(host.scene()).timeDebtTicks, 0);
    ASSERT_EQ(fxScene_RestoreState(host.scene(), state.data(), size), FX_OK);
    EXPECT_EQ(hashOf(host.scene()), hashOf(free.scene()));
}

TEST(WorkBudget, theHostMaySpeakToAnInstanceThatEndsWithTheStepInHand)
{
    const std::string preset = R"({"version":1,"duration":0.01,"emitters":[{"name":"e","maxParticles":20000,
        "lifetime":1,"emission":{"bursts":[{"time":0,"count":20000}]},"forces":{"curlStrength":1}}]})";
    Host host(30'000);
    const FxInstanceId id = host.add(preset);
    ASSERT_GT(host.update(kFrame).timeDebtTicks, 0);
    FxInstanceParameters parameters = fxDefaultInstanceParameters();
    parameters.intensity = 0.5f;
    EXPECT_EQ(fxScene_SetParameters(host.scene(), id, &parameters), FX_OK);
    host.payDebt();
    EXPECT_EQ(host.stateOf(id), FX_INSTANCE_FINISHED);
}

namespace {

/// Two emitters that feel a wind, one of which gives birth in the other.
std::string linkedPreset()
{
    return R"({"version":1,"duration":60,"emitters":[{"name":"a","maxParticles":300,"lifetime":1,
        "emission":{"rate":250},"forces":{"curlStrength":1,"drag":1},
        "events":[{"on":"age","age":0.5,"emit":"b","count":3}]},
        {"name":"b","maxParticles":900,"lifetime":1,"forces":{"curlStrength":1,"drag":1}}]})";
}

} // namespace

TEST(WorkBudget, aSeekThatRunsOutOfMemoryOnItsWayChangesNothingAndGoesOn)
{
    for (const auto& [preset, budget] :
         {std::pair(swirlPreset(0), uint64_t(60'000)), std::pair(linkedPreset(), uint64_t(200'000))})
    {
        int failures = 0;
        for (int late = 0; late < 8; ++late) {
            HostAllocator memory;
            Host free(0), bounded(budget, 1, 30 * FX_TICKS_PER_SECOND, &memory);
            const FxInstanceId there = free.add(preset), id = bounded.add(preset);
            for (Host* const host : {&free, &bounded}) {
                host->update(kFrame);
                ASSERT_EQ(fxScene_SeekInstance(host->scene(), host == &free ? there : id, 3.0), FX_OK);
                for (int i = 0; i < late; ++i)
                    host->update(kFrame);
            }
            ASSERT_EQ(bounded.stateOf(id), FX_INSTANCE_WAKING);
            for (int i = 0; i < 3; ++i) {
                free.update(kFrame);
                memory.failFrom(1);
                const FxResult result = fxScene_Update(bounded.scene(), kFrame);
                memory.failFrom(0);
                EXPECT_TRUE(result == FX_OK || result == FX_ERROR_OUT_OF_MEMORY);
                failures += result == FX_ERROR_OUT_OF_MEMORY ? 1 : 0;
            }
            if (late % 2 == 0) {
                EXPECT_EQ(simulationHashOf(bounded.scene()), simulationHashOf(free.scene())) << late;
            }
            for (int i = 0; i < 400 && bounded.stateOf(id) == FX_INSTANCE_WAKING; ++i)
                for (Host* const host : {&free, &bounded})
                    host->update(kFrame);
            EXPECT_EQ(bounded.stateOf(id), FX_INSTANCE_ACTIVE);
            EXPECT_EQ(simulationHashOf(bounded.scene()), simulationHashOf(free.scene())) << late;
        }
        EXPECT_GT(failures, 0);
    }
}

TEST(WorkBudget, debtBeyondTheLongestAbsenceIsDroppedAndCounted)
{
    const int64_t longest = FX_TICKS_PER_SECOND / 10;
    Host host(kBusyBudget, 1, longest);
    host.add(busyPreset());
    FxSceneStatistics statistics = {};
    for (int i = 0; i < 60; ++i) {
        statistics = host.update(kFrame);
        EXPECT_LE(statistics.timeDebtTicks, longest);
    }
    EXPECT_GT(statistics.droppedTicks, 0);
    const int64_t all = 60 * (FX_TICKS_PER_SECOND / 60);
    EXPECT_EQ(statistics.simulatedTick + statistics.timeDebtTicks + statistics.droppedTicks, all);
}

TEST(WorkBudget, ordinaryScenesNeverMeetTheUsualOne)
{
    const FxSceneDef def = fxDefaultSceneDef();
    Host host(def.workBudget);
    for (uint64_t seed = 0; seed < 20; ++seed)
        host.add(swirlPreset(2), seed);
    for (int i = 0; i < 30; ++i) {
        const FxSceneStatistics statistics = host.update(kFrame);
        EXPECT_LT(statistics.updateWork, def.workBudget / 2);
        EXPECT_EQ(statistics.timeDebtTicks, 0);
        EXPECT_EQ(statistics.instancesWaking, 0u);
    }
}
