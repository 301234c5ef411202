// The events that a scene records, and their order, depend on nothing but the calls of the host.
#include "tests/api/event_presets.h"

using namespace fx::test;

namespace {

/// How a run differs from others.
struct Way
{
    uint32_t workers = 1;
    uint32_t shares = 1;
    uint32_t capacity = 1 << 16;
    uint64_t workBudget = 0;
    int updatesOfAStep = 1; ///< below 0: steps of an update
    const std::string& preset = kSparks;
};

/// All events of 1 s of five instances, three of which are equal.
std::vector<FxEvent> sparksBy(const Way& way, FxSceneStatistics* outStatistics = nullptr)
{
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.workers = way.workers;
    FxContext* context = nullptr;
    EXPECT_EQ(fxCreateContext(&contextDef, &context), FX_OK);
    FxSceneDef def = fxDefaultSceneDef();
    def.eventCapacity = way.capacity;
    def.eventKinds = kAllEvents;
    def.shareInstances = way.shares;
    if (way.workBudget > 0)
        def.workBudget = way.workBudget;
    def.maxFrameTicks = FX_TICKS_PER_SECOND;
    FxScene* scene = nullptr;
    EXPECT_EQ(fxCreateScene(context, &def, &scene), FX_OK);
    FxInstanceDef instance = fxDefaultInstanceDef();
    instance.preset = loadText(context, way.preset);
    std::vector<FxInstanceId> ids;
    for (int i = 0; i < 5; ++i) {
        instance.seed = i % 2 == 0 ? 1 : 2 + uint64_t(i);
        instance.position[0] = 10.0 * i;
        instance.userData = 100 + uint64_t(i);
        ids.emplace_back();
        EXPECT_EQ(fxScene_CreateInstance(scene, &instance, &ids.back()), FX_OK);
    }
    std::vector<FxEvent> all;
    const int updates = way.updatesOfAStep > 0 ? 60 * way.updatesOfAStep : 60 / -way.updatesOfAStep;
    for (int i = 0; i < updates || (way.workBudget > 0 && i < 5000); ++i) {
        EXPECT_EQ(fxScene_Update(scene, i < updates ? 1.0 / updates : 0.0), FX_OK);
        FxSceneStatistics now{};
        now.structSize = sizeof now;
        EXPECT_EQ(fxScene_GetStatistics(scene, &now), FX_OK);
        std::vector<FxEvent> some(now.eventsPending + 1);
        some[0].structSize = sizeof(FxEvent);
        uint32_t count = 0;
        const bool isRoomy = way.capacity >= 1 << 16;
        EXPECT_EQ(fxScene_GetEvents(scene, some.data(), isRoomy ? uint32_t(some.size()) : 0, &count, nullptr),
                  FX_OK);
        some.resize(count);
        all.insert(all.end(), some.begin(), some.end());
        if (way.workBudget > 0 && i >= updates) { // until nothing is left to do
            EXPECT_EQ(fxScene_Update(scene, 1e-9), FX_OK);
            if (now.simulatedTick >= FX_TICKS_PER_SECOND)
                break;
        }
    }
    FxSceneStatistics now{};
    now.structSize = sizeof now;
    EXPECT_EQ(fxScene_GetStatistics(scene, &now), FX_OK);
    if (outStatistics)
        *outStatistics = now;
    std::vector<FxEvent> rest(now.eventsPending + 1);
    rest[0].structSize = sizeof(FxEvent);
    uint32_t count = 0;
    EXPECT_EQ(fxScene_GetEvents(scene, rest.data(), uint32_t(rest.size()), &count, nullptr), FX_OK);
    all.insert(all.end(), rest.begin(), rest.begin() + count);
    for (FxEvent& event : all) // ids differ from run to run
        event.instance.bits = 0;
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
    return all;
}

/// FNV-1a of all bits.
uint64_t hashOf(const std::vector<FxEvent>& events)
{
    uint64_t hash = 0xcbf29ce484222325u;
    const auto* bytes = reinterpret_cast<const unsigned char*>(events.data());
    for (size_t i = 0; i < events.size() * sizeof(FxEvent); ++i)
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}

} // namespace

TEST(EventOrder, eventsAreTheSameForThreadsSharingBudgetsAndDivisionsOfTime)
{
    const std::vector<FxEvent> reference = sparksBy({});
    ASSERT_GT(reference.size(), 1500u);
    for (const uint32_t workers : {2u, 3u, 16u})
        EXPECT_TRUE(areEqual(sparksBy({workers}), reference)) << workers << " workers";
    EXPECT_TRUE(areEqual(sparksBy({1, 0}), reference)) << "without sharing";
    EXPECT_TRUE(areEqual(sparksBy({1, 1, 1 << 16, 0, 3}), reference)) << "three updates a step";
    EXPECT_TRUE(areEqual(sparksBy({1, 1, 1 << 16, 0, -4}), reference)) << "four steps an update";
    EXPECT_TRUE(areEqual(sparksBy({2, 1, 1 << 16, 3000}), reference)) << "a small work budget";
}

TEST(EventOrder, eventsAreTheSameOnEveryInstructionSet) // scripts/check-all runs this with each
{
    EXPECT_EQ(hashOf(sparksBy({})), 4215043137112565923u);
}

TEST(EventOrder, whatDoesNotFitIsLostAndCountedWithAndWithoutSharing)
{
    FxSceneStatistics statistics{};
    const std::vector<FxEvent> all = sparksBy({});
    for (const uint32_t capacity : {1u, 100u, 1500u})
        for (const uint32_t shares : {0u, 1u}) {
            const std::vector<FxEvent> some = sparksBy({1, shares, capacity}, &statistics);
            EXPECT_TRUE(areEqual(some, {all.begin(), all.begin() + capacity})) << capacity;
            EXPECT_EQ(statistics.eventsLost, all.size() - capacity) << shares;
            EXPECT_EQ(statistics.eventsPending, capacity);
        }
}

TEST(EventOrder, ofAStepWithTooManyEventsTheFirstInTimeAreKept)
{
    FxSceneStatistics statistics{};
    const std::vector<FxEvent> all = sparksBy({1, 1, 1 << 16, 0, 1, kFlash});
    ASSERT_GE(all.size(), 3000u);
    for (const uint32_t capacity : {1u, 7u, 500u, 2000u})
        for (const uint32_t shares : {0u, 1u}) {
            const std::vector<FxEvent> some = sparksBy({1, shares, capacity, 0, 1, kFlash}, &statistics);
            EXPECT_TRUE(areEqual(some, {all.begin(), all.begin() + capacity})) << capacity << " " << shares;
            EXPECT_EQ(statistics.eventsLost, all.size() - capacity) << capacity << " " << shares;
        }
}
