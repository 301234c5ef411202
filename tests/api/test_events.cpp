// Events that a scene records for its host.
#include "tests/api/event_presets.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <thread>
#include <vector>

using namespace fx::test;

namespace {

class EventApi : public ApiTest
{
protected:
    ~EventApi() override { EXPECT_EQ(fxDestroyScene(events_), FX_OK); }

    FxScene* open(const std::function<void(FxSceneDef&)>& change = {})
    {
        FxSceneDef def = fxDefaultSceneDef();
        def.eventCapacity = 1000;
        if (change)
            change(def);
        EXPECT_EQ(fxCreateScene(context_, &def, &events_), FX_OK) << fxGetLastErrorMessage();
        return events_;
    }
    FxInstanceId add(const std::string& text, const std::function<void(FxInstanceDef&)>& change = {})
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = preset_ = loadText(context_, text);
        if (change)
            change(def);
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(events_, &def, &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }
    void update(int frames) const
    {
        for (int frame = 0; frame < frames; ++frame)
            ASSERT_EQ(fxScene_Update(events_, kFrame), FX_OK);
    }
    static std::vector<FxEvent> take(FxScene* scene)
    {
        uint32_t count = 0;
        EXPECT_EQ(fxScene_GetEvents(scene, nullptr, 0, &count, nullptr), FX_OK);
        std::vector<FxEvent> events(count + 1);
        events[0].structSize = sizeof(FxEvent);
        EXPECT_EQ(fxScene_GetEvents(scene, events.data(), count + 1, &count, nullptr), FX_OK)
            << fxGetLastErrorMessage();
        events.resize(count);
        return events;
    }
    std::vector<FxEvent> take() const { return take(events_); }
    uint32_t cue(const char* name) const
    {
        uint32_t found = FX_NO_CUE;
        EXPECT_EQ(fxFindPresetCue(context_, preset_, name, &found), FX_OK) << fxGetLastErrorMessage();
        return found;
    }
    static const FxEvent* find(const std::vector<FxEvent>& events, uint32_t kind)
    {
        const auto found =
            std::find_if(events.begin(), events.end(), [&](const FxEvent& e) { return e.kind == kind; });
        return found == events.end() ? nullptr : &*found;
    }

    FxScene* events_ = nullptr;
    FxPresetId preset_{};
};

} // namespace

TEST_F(EventApi, aSceneRecordsNothingByDefault)
{
    FxSceneDef def = fxDefaultSceneDef();
    EXPECT_EQ(def.eventCapacity, 0u);
    open([](FxSceneDef& scene) { scene.eventCapacity = 0; });
    add(kDrop);
    update(120);
    uint32_t count = 7;
    EXPECT_EQ(fxScene_GetEvents(events_, nullptr, 0, &count, nullptr), FX_OK);
    EXPECT_EQ(count, 0u);
}

TEST_F(EventApi, aDropIsBornHitsTheGroundAgesAndDiesWhenPhysicsSaysSo)
{
    open();
    const FxInstanceId id = add(kDrop, [](FxInstanceDef& def) { def.userData = 0x123456789abcdef0u; });
    update(100);
    const std::vector<FxEvent> events = take();
    const FxEvent* const born = find(events, FX_EVENT_BORN);
    const FxEvent* const hit = find(events, FX_EVENT_COLLIDED);
    const FxEvent* const aged = find(events, FX_EVENT_AGED);
    const FxEvent* const died = find(events, FX_EVENT_DIED);
    ASSERT_TRUE(born && hit && aged && died);
    EXPECT_EQ(born, &events.front());
    EXPECT_EQ(born->tick, 0);
    EXPECT_DOUBLE_EQ(born->position[1], 1.0);
    EXPECT_EQ(aged->tick, FX_TICKS_PER_SECOND);
    EXPECT_NEAR(died->seconds, 1.5, 1e-6); // lifetimes are floats
    const double height = hit->position[1];
    const double fall = std::sqrt(2.0 * (1.0 - height) / 9.80665);
    EXPECT_NEAR(height, 0.0, 0.02);
    EXPECT_NEAR(hit->seconds, fall, 0.01);
    EXPECT_NEAR(double(hit->speed), 9.80665 * fall, 0.1);
    EXPECT_NEAR(double(hit->velocity[1]), 0.5 * double(hit->speed), 0.05); // just after the contact
    EXPECT_EQ(hit->normal[1], 1.0f);
    EXPECT_EQ(hit->normal[0], 0.0f);
    EXPECT_DOUBLE_EQ(hit->seconds, double(hit->tick) / double(FX_TICKS_PER_SECOND));
    EXPECT_EQ(hit->cue, cue("impact"));
    EXPECT_EQ(died->cue, cue("gone"));
    for (const FxEvent& event : events) {
        EXPECT_EQ(event.structSize, sizeof(FxEvent));
        EXPECT_EQ(event.instance.bits, id.bits);
        EXPECT_EQ(event.userData, 0x123456789abcdef0u);
    }
    EXPECT_TRUE(std::is_sorted(events.begin(), events.end(),
                               [](const FxEvent& a, const FxEvent& b) { return a.tick < b.tick; }));
    EXPECT_TRUE(take().empty()); // each is read once
}

TEST_F(EventApi, positionsAndVectorsAreThoseOfTheWorld)
{
    open();
    const float half = std::sqrt(0.5f);
    add(kDrop, [&](FxInstanceDef& def) {
        def.position[0] = 10.0;
        def.position[1] = 5.0;
        def.scale = 2.0f;
        def.rotation[1] = half; // a quarter turn about the vertical keeps gravity
        def.rotation[3] = half;
    });
    update(60);
    const std::vector<FxEvent> events = take();
    ASSERT_TRUE(find(events, FX_EVENT_BORN) && find(events, FX_EVENT_COLLIDED));
    EXPECT_NEAR(find(events, FX_EVENT_BORN)->position[1], 5.0 + 2.0, 1e-6);
    const FxEvent& hit = *find(events, FX_EVENT_COLLIDED);
    EXPECT_NEAR(hit.position[0], 10.0, 1e-6);
    EXPECT_NEAR(hit.position[1], 5.0, 0.04);
    EXPECT_NEAR(double(hit.normal[1]), 1.0, 1e-6);
    EXPECT_NEAR(double(hit.speed), 2.0 * std::sqrt(2.0 * 9.80665), 0.2); // lengths are scaled, time is not
    EXPECT_NEAR(double(hit.velocity[1]), 0.5 * double(hit.speed), 0.1);
}

TEST_F(EventApi, theNormalOfATiltedGroundIsTiltedToo)
{
    open();
    const double tilt = 0.4;
    add(kDrop, [&](FxInstanceDef& def) {
        def.rotation[2] = float(std::sin(0.5 * tilt));
        def.rotation[3] = float(std::cos(0.5 * tilt));
    });
    update(60);
    const std::vector<FxEvent> events = take();
    ASSERT_TRUE(find(events, FX_EVENT_COLLIDED));
    const FxEvent& hit = *find(events, FX_EVENT_COLLIDED);
    EXPECT_NEAR(double(hit.normal[0]), -std::sin(tilt), 1e-5);
    EXPECT_NEAR(double(hit.normal[1]), std::cos(tilt), 1e-5);
}

TEST_F(EventApi, particlesThatStayInTheWorldHaveEventsAtTheirPlaceThere)
{
    open();
    std::string world = kDrop;
    world.insert(world.find("\"position\""), "\"space\":\"world\",");
    const FxInstanceId id = add(world, [](FxInstanceDef& def) { def.position[0] = 3.0; });
    update(6);
    const double away[3] = {100.0, 0.0, 0.0};
    const float still[4] = {0, 0, 0, 1};
    ASSERT_EQ(fxScene_SetTransform(events_, id, away, still, 1.0f), FX_OK);
    update(60);
    const std::vector<FxEvent> events = take();
    ASSERT_TRUE(find(events, FX_EVENT_COLLIDED));
    EXPECT_NEAR(find(events, FX_EVENT_COLLIDED)->position[0], 3.0, 1e-5);
}

TEST_F(EventApi, aTriggerOfTheHostIsAnEventThatItsSpeedAndStartPlaceInSceneTime)
{
    open();
    const FxInstanceId id = add(kDrop, [](FxInstanceDef& def) { def.startTick = FX_TICKS_PER_SECOND / 10; });
    ASSERT_EQ(fxScene_SetInstanceSpeed(events_, id, 2.0f), FX_OK);
    update(12);
    take();
    ASSERT_EQ(fxScene_TriggerEvent(events_, id, "knock", 2), FX_OK);
    update(60);
    const std::vector<FxEvent> events = take();
    EXPECT_EQ(std::count_if(events.begin(), events.end(),
                            [](const FxEvent& e) { return e.kind == FX_EVENT_TRIGGERED; }),
              2);
    EXPECT_EQ(find(events, FX_EVENT_TRIGGERED)->cue, cue("knocked"));
    EXPECT_NEAR(find(events, FX_EVENT_TRIGGERED)->seconds, 12.0 / 60, 1e-6);
    ASSERT_TRUE(find(events, FX_EVENT_AGED));
    EXPECT_NEAR(find(events, FX_EVENT_AGED)->seconds, 0.1 + 1.0 / 2, 1e-6);
}

TEST_F(EventApi, theEndOfAnInstanceIsAnEvent)
{
    open();
    const std::string brief = burstPreset(3, 0.2);
    const FxInstanceId kept = add(brief, [](FxInstanceDef& def) { def.userData = 1; });
    const FxInstanceId gone = add(brief, [](FxInstanceDef& def) {
        def.userData = 2;
        def.position[2] = 4.0;
        def.destroyWhenFinished = 1;
    });
    update(30);
    const std::vector<FxEvent> events = take();
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].instance.bits, kept.bits);
    EXPECT_EQ(events[1].instance.bits, gone.bits);
    EXPECT_EQ(events[1].kind, uint32_t(FX_EVENT_FINISHED));
    EXPECT_EQ(events[1].userData, 2u);
    EXPECT_EQ(events[1].position[2], 4.0);
    EXPECT_EQ(events[1].cue, FX_NO_CUE);
    EXPECT_NEAR(events[1].seconds, 0.2, 2.0 / 60);
    EXPECT_EQ(fxScene_IsValid(events_, gone), 0u);
}

TEST_F(EventApi, theKindsOfTheSceneSayWhatIsRecorded)
{
    for (const uint32_t kinds : {0u, uint32_t(FX_EVENTS_CUES), uint32_t(FX_EVENTS_UNNAMED), kAllEvents}) {
        ASSERT_EQ(fxDestroyScene(events_), FX_OK);
        open([&](FxSceneDef& def) {
            def.eventKinds = kinds;
            def.eventCapacity = 100000;
        });
        add(kSparks, [](FxInstanceDef& def) { def.destroyWhenFinished = 1; });
        update(60);
        const std::vector<FxEvent> events = take();
        const auto count = [&](bool isNamed) {
            return std::count_if(events.begin(), events.end(),
                                 [&](const FxEvent& e) { return (e.cue != FX_NO_CUE) == isNamed; });
        };
        EXPECT_EQ(count(true) > 0, (kinds & FX_EVENTS_CUES) != 0) << kinds;
        EXPECT_EQ(count(false) > 0, (kinds & FX_EVENTS_UNNAMED) != 0) << kinds;
    }
}

TEST_F(EventApi, theProbabilityOfARuleIsThatOfItsCue)
{
    open([](FxSceneDef& def) {
        def.eventKinds = kAllEvents;
        def.eventCapacity = 100000;
    });
    add(kSparks);
    update(120);
    const std::vector<FxEvent> events = take();
    double ticks = 0, contacts = 0;
    for (const FxEvent& event : events)
        if (event.kind == FX_EVENT_COLLIDED)
            (event.cue == FX_NO_CUE ? contacts : ticks) += 1;
    ASSERT_GT(contacts, 200.0);
    EXPECT_NEAR(ticks / contacts, 0.7, 0.1);
}

TEST_F(EventApi, readingInPartsGivesTheSameEventsAndMakesRoom)
{
    open([](FxSceneDef& def) { def.eventCapacity = 10; });
    add(kSparks);
    update(60);
    uint32_t count = 0;
    uint64_t lost = 0;
    FxEvent some[6]{};
    some[0].structSize = sizeof(FxEvent);
    ASSERT_EQ(fxScene_GetEvents(events_, some, 6, &count, &lost), FX_OK);
    EXPECT_EQ(count, 6u);
    EXPECT_GT(lost, 0u);
    ASSERT_EQ(fxScene_GetEvents(events_, nullptr, 0, &count, nullptr), FX_OK);
    EXPECT_EQ(count, 4u);
    update(10);
    ASSERT_EQ(fxScene_GetEvents(events_, nullptr, 0, &count, nullptr), FX_OK);
    EXPECT_EQ(count, 10u);
    const int64_t last = some[5].tick;
    ASSERT_EQ(fxScene_GetEvents(events_, some, 6, &count, nullptr), FX_OK);
    EXPECT_GE(some[0].tick, last);
    EXPECT_LT(some[0].tick, FX_TICKS_PER_SECOND); // the oldest come first
    EXPECT_GE(some[4].tick, FX_TICKS_PER_SECOND - 1);
    ASSERT_EQ(fxScene_GetEvents(events_, some, 0, &count, nullptr), FX_OK);
    EXPECT_EQ(count, 0u);
}

TEST_F(EventApi, anOlderHostGetsTheMembersThatItKnows)
{
    open();
    add(kDrop);
    update(60);
    constexpr uint32_t kOld = 48; // up to the time
    std::vector<uint64_t> memory(100 * kOld / 8 + 1, ~uint64_t(0));
    auto* const events = reinterpret_cast<FxEvent*>(memory.data());
    events->structSize = kOld;
    uint32_t count = 0;
    ASSERT_EQ(fxScene_GetEvents(events_, events, 100, &count, nullptr), FX_OK) << fxGetLastErrorMessage();
    ASSERT_GE(count, 2u);
    const auto* const second = reinterpret_cast<const FxEvent*>(&memory[kOld / 8]);
    EXPECT_EQ(second->structSize, kOld);
    EXPECT_EQ(second->kind, uint32_t(FX_EVENT_COLLIDED));
    EXPECT_EQ(memory[count * kOld / 8], ~uint64_t(0));
    events->structSize = 4;
    EXPECT_EQ(fxScene_GetEvents(events_, events, 100, &count, nullptr), FX_ERROR_VERSION);
}

TEST_F(EventApi, timeThatASeekOrAPrewarmPassesGivesNoEvents)
{
    open();
    std::string warm = kDrop;
    warm.insert(warm.find("\"emitters\""), "\"prewarm\":1.2,");
    const FxInstanceId id = add(warm);
    update(1);
    EXPECT_TRUE(take().empty());
    ASSERT_EQ(fxScene_SeekInstance(events_, id, 0.25), FX_OK);
    ASSERT_EQ(fxScene_SeekInstance(events_, id, 0.95), FX_OK);
    update(1);
    EXPECT_TRUE(take().empty());
    update(60); // what comes after it is told
    const std::vector<FxEvent> events = take();
    EXPECT_TRUE(find(events, FX_EVENT_AGED) && find(events, FX_EVENT_DIED));
    EXPECT_FALSE(find(events, FX_EVENT_BORN));
}

TEST_F(EventApi, aHiddenInstanceHasNoEventsAndTellsNothingLater)
{
    for (const uint32_t isCulled : {1u, 0u}) {
        ASSERT_EQ(fxDestroyScene(events_), FX_OK);
        open([&](FxSceneDef& def) { def.disableCulling = 1 - isCulled; });
        add(kDrop, [](FxInstanceDef& def) { def.position[2] = 500.0; });
        FxFocus focus = fxDefaultFocus(); // looks the other way
        const float projection[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -0.2f, 0};
        std::copy_n(projection, 16, focus.projection);
        ASSERT_EQ(fxScene_SetFocus(events_, &focus, 1), FX_OK) << fxGetLastErrorMessage();
        update(50);
        EXPECT_EQ(find(take(), FX_EVENT_COLLIDED) == nullptr, isCulled != 0);
        ASSERT_EQ(fxScene_SetFocus(events_, nullptr, 0), FX_OK);
        update(20);
        EXPECT_EQ(find(take(), FX_EVENT_BORN), nullptr);
        update(40);
        EXPECT_NE(find(take(), FX_EVENT_DIED), nullptr);
    }
}

TEST_F(EventApi, aStateKeepsUserDataAndNoEvents)
{
    open();
    const FxInstanceId id = add(kDrop, [](FxInstanceDef& def) { def.userData = 77; });
    uint64_t before = 0, after = 0;
    ASSERT_EQ(fxScene_GetSimulationHash(events_, &before), FX_OK);
    size_t size = 0;
    update(20);
    ASSERT_EQ(fxScene_SaveState(events_, nullptr, 0, &size), FX_OK);
    std::vector<std::byte> state(size);
    ASSERT_EQ(fxScene_SaveState(events_, state.data(), size, &size), FX_OK);
    take();
    update(40);
    const std::vector<FxEvent> first = take();
    ASSERT_FALSE(first.empty());
    update(40);
    ASSERT_EQ(fxScene_RestoreState(events_, state.data(), size), FX_OK) << fxGetLastErrorMessage();
    EXPECT_TRUE(take().empty());
    uint64_t userData = 0;
    EXPECT_EQ(fxScene_GetUserData(events_, id, &userData), FX_OK);
    EXPECT_EQ(userData, 77u);
    update(40);
    EXPECT_TRUE(areEqual(take(), first));
    // User data is of no influence on later steps.
    ASSERT_EQ(fxDestroyScene(events_), FX_OK);
    open();
    add(kDrop, [](FxInstanceDef& def) { def.userData = 78; });
    ASSERT_EQ(fxScene_GetSimulationHash(events_, &after), FX_OK);
    EXPECT_EQ(before, after);
}

TEST_F(EventApi, recordingChangesNoParticle)
{
    open([](FxSceneDef& def) { def.eventKinds = kAllEvents; });
    add(kSparks);
    update(60);
    uint64_t with = 0, without = 0;
    ASSERT_EQ(fxScene_GetStateHash(events_, &with), FX_OK);
    ASSERT_EQ(fxDestroyScene(events_), FX_OK);
    open([](FxSceneDef& def) { def.eventCapacity = 0; });
    add(kSparks);
    update(60);
    ASSERT_EQ(fxScene_GetStateHash(events_, &without), FX_OK);
    EXPECT_EQ(with, without);
}

TEST_F(EventApi, recordingAllocatesNothingOnceTheSceneIsWarm)
{
    open([](FxSceneDef& def) { def.eventKinds = kAllEvents; });
    add(kSparks);
    update(60);
    for (int frame = 0; frame < 60; ++frame) {
        update(1);
        FxSceneStatistics now{};
        now.structSize = sizeof now;
        ASSERT_EQ(fxScene_GetStatistics(events_, &now), FX_OK);
        ASSERT_EQ(now.updateAllocations, 0u) << frame;
        ASSERT_GT(now.eventsPending, 0u);
        take();
    }
}

TEST_F(EventApi, cuesAreFoundByNameAndIndex)
{
    open();
    add(kSparks);
    FxPresetInfo info{};
    info.structSize = sizeof info;
    ASSERT_EQ(fxGetPresetInfo(context_, preset_, &info), FX_OK);
    EXPECT_EQ(info.cueCount, 3u);
    for (uint32_t i = 0; i < info.cueCount; ++i) {
        FxPresetCue one{};
        one.structSize = sizeof one;
        ASSERT_EQ(fxGetPresetCue(context_, preset_, i, &one), FX_OK);
        EXPECT_EQ(one.cue, i);
        EXPECT_EQ(cue(one.name), i);
    }
    uint32_t found = 9;
    EXPECT_EQ(fxFindPresetCue(context_, preset_, "tikc", &found), FX_ERROR_NOT_FOUND);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "did you mean \"tick\"?"), nullptr)
        << fxGetLastErrorMessage();
    EXPECT_EQ(found, 9u);
    FxPresetCue one{};
    one.structSize = sizeof one;
    EXPECT_EQ(fxGetPresetCue(context_, preset_, 3, &one), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxGetPresetCue(context_, preset_, 0, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxGetPresetCue(context_, {}, 0, &one), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxGetPresetCue(nullptr, preset_, 0, &one), FX_ERROR_INVALID_ARGUMENT);
    one.structSize = 3;
    EXPECT_EQ(fxGetPresetCue(context_, preset_, 0, &one), FX_ERROR_VERSION);
    EXPECT_EQ(fxFindPresetCue(context_, preset_, nullptr, &found), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxFindPresetCue(context_, preset_, "tick", nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxFindPresetCue(context_, {}, "tick", &found), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxFindPresetCue(nullptr, preset_, "tick", &found), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(EventApi, wrongArgumentsAreRefusedAndChangeNothing)
{
    FxSceneDef def = fxDefaultSceneDef();
    FxScene* none = nullptr;
    def.eventCapacity = 1'000'001;
    EXPECT_EQ(fxCreateScene(context_, &def, &none), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "eventCapacity"), nullptr) << fxGetLastErrorMessage();
    def.eventCapacity = 1;
    def.eventKinds = 8;
    EXPECT_EQ(fxCreateScene(context_, &def, &none), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "eventKinds"), nullptr) << fxGetLastErrorMessage();
    open();
    const FxInstanceId id = add(kDrop);
    update(60);
    uint32_t count = 5;
    uint64_t userData = 5;
    FxEvent event{};
    EXPECT_EQ(fxScene_GetEvents(nullptr, nullptr, 0, &count, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetEvents(events_, nullptr, 0, nullptr, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetEvents(events_, &event, 1, &count, nullptr), FX_ERROR_VERSION);
    EXPECT_EQ(fxScene_GetUserData(events_, id, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetUserData(events_, {}, &userData), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxScene_GetUserData(nullptr, id, &userData), FX_ERROR_INVALID_ARGUMENT);
    std::thread([&] {
        EXPECT_EQ(fxScene_GetEvents(events_, nullptr, 0, &count, nullptr), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_GetUserData(events_, id, &userData), FX_ERROR_WRONG_THREAD);
    }).join();
    EXPECT_EQ(count, 5u);
    EXPECT_EQ(userData, 5u);
    EXPECT_GE(take().size(), 2u);
}

TEST_F(EventApi, aPresetThatIsReplacedGivesNoEventsOfItsPast)
{
    open();
    const FxInstanceId id = add(kDrop, [](FxInstanceDef& def) { def.userData = 5; });
    update(20); // the drop is in the air
    const FxPresetId before = preset_;
    EXPECT_NE(find(take(), FX_EVENT_BORN), nullptr);
    preset_ = loadText(context_, kDrop);
    ASSERT_EQ(fxScene_ReplacePreset(events_, before, preset_, FX_REPLACE_SEEK, nullptr), FX_OK);
    EXPECT_TRUE(take().empty());
    update(100);
    const std::vector<FxEvent> events = take();
    EXPECT_EQ(find(events, FX_EVENT_BORN), nullptr);
    const FxEvent* const hit = find(events, FX_EVENT_COLLIDED);
    ASSERT_NE(hit, nullptr);
    EXPECT_EQ(hit->instance.bits, id.bits);
    EXPECT_EQ(hit->userData, 5u);
    EXPECT_EQ(hit->cue, cue("impact"));
}
