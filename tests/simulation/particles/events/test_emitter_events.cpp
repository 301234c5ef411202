#include "simulation/emitters/events/event_board.h"
#include "simulation/particles/collisions/collision_op.h"
#include "tests/simulation/particles/events/linked.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;
using base::kTicksPerSecond;

namespace {

/// Balls thrown up that each leave one mark, by `rule`.
std::shared_ptr<EffectDef> thrown(const EventRule& rule, float lifetime)
{
    auto ball = burstEmitter(1);
    ball->lifetime = {lifetime, lifetime};
    ball->speed = {5, 5};
    ball->shape = EmitterShape::Cone;
    ball->events = {rule};
    return linkedEffect(std::move(ball), fedEmitter());
}

/// One ball that falls on a plane from 1 m and keeps half of its speed.
std::unique_ptr<EmitterDef> bouncing(ContactResponse response)
{
    CollisionDef plane;
    plane.restitution = 0.5f;
    plane.response = response;
    auto ball = burstEmitter(1);
    ball->position = {0, 1, 0};
    ball->modules = {makeCollisionOp(std::span(&plane, 1))};
    return ball;
}

} // namespace

TEST(EmitterEvents, aDeathGivesBirthAtItsPlaceAndAtItsMoment)
{
    Stage stage;
    stage.add({}, thrown(ruleOf(EventKind::Death, 1), 0.7f));
    stage.play(60);
    const auto marks = particlesOf(stage.look(), 1);
    ASSERT_EQ(marks.size(), 1u);
    EXPECT_NEAR(marks[0].position.y, 5.0 * 0.7 - 0.5 * 9.80665 * 0.7 * 0.7, 1e-5);
    EXPECT_NEAR(marks[0].age, 0.3, 1e-6);
}

TEST(EmitterEvents, anAgeIsReachedOnceAndOnlyByThoseWhoLiveSoLong)
{
    EventRule rule = ruleOf(EventKind::Age, 1, 3);
    rule.age = kTicksPerSecond / 4;
    Stage stage;
    stage.add({}, thrown(rule, 0.7f));
    stage.play(60);
    const auto marks = particlesOf(stage.look(), 1);
    ASSERT_EQ(marks.size(), 3u);
    EXPECT_NEAR(marks[0].position.y, 5.0 * 0.25 - 0.5 * 9.80665 * 0.25 * 0.25, 1e-5);
    EXPECT_NEAR(marks[0].age, 0.75, 1e-6);
    Stage brief;
    brief.add({}, thrown(rule, 0.2f));
    brief.play(60);
    EXPECT_TRUE(particlesOf(brief.look(), 1).empty());
}

TEST(EmitterEvents, aShareOfTheVelocityIsInherited)
{
    EventRule rule = ruleOf(EventKind::Birth, 1);
    rule.inheritVelocity = 0.5f;
    Stage stage;
    stage.add({}, thrown(rule, 10.0f));
    stage.play(60);
    const auto marks = particlesOf(stage.look(), 1);
    ASSERT_EQ(marks.size(), 1u);
    EXPECT_NEAR(marks[0].position.y, 0.5 * 5.0 * 1.0, 1e-5);
}

TEST(EmitterEvents, aBallThatKeepsHalfItsSpeedBouncesAsOftenAsTheSeriesSays)
{
    auto ball = bouncing(ContactResponse::Bounce);
    ball->events = {ruleOf(EventKind::Collision, 1)};
    Stage stage;
    stage.add({}, linkedEffect(std::move(ball), fedEmitter()));
    const double fall = std::sqrt(2.0 / 9.80665);
    // contacts at fall (1, 1 + 1, 1 + 1 + 1/2, ...): the third is at 2.5, the fourth at 2.75 times the fall
    const int steps = int(2.6 * fall * 60.0);
    stage.play(steps);
    const auto marks = particlesOf(stage.look(), 1);
    ASSERT_EQ(marks.size(), 3u);
    EXPECT_NEAR(marks[0].age, steps / 60.0 - fall, 2e-3);
    EXPECT_NEAR(marks[1].age, steps / 60.0 - 2.0 * fall, 2e-2);
    for (const Seen& mark : marks)
        EXPECT_NEAR(mark.position.y, 0.0f, 1e-2);
}

TEST(EmitterEvents, whoIsKilledByAContactDiesOnce)
{
    auto ball = bouncing(ContactResponse::Kill);
    ball->lifetime = {0.5f, 0.5f}; // the contact is at 0.4516 s
    ball->events = {ruleOf(EventKind::Death, 1)};
    Stage stage;
    stage.add({}, linkedEffect(std::move(ball), fedEmitter()));
    stage.play(60);
    const auto marks = particlesOf(stage.look(), 1);
    ASSERT_EQ(marks.size(), 1u);
    EXPECT_NEAR(marks[0].age, 1.0 - std::sqrt(2.0 / 9.80665), 1e-3);
}

TEST(EmitterEvents, countsAndProbabilitiesHoldOnAverage)
{
    auto parents = burstEmitter(4000);
    parents->maxParticles = 4000;
    EventRule rule = ruleOf(EventKind::Birth, 1);
    rule.fewest = 2;
    rule.most = 5;
    rule.probability = 0.25f;
    parents->events = {rule};
    auto marks = fedEmitter();
    marks->maxParticles = 20000;
    Stage stage;
    const Slot slot = stage.add({}, linkedEffect(std::move(parents), std::move(marks)));
    stage.step();
    const double born = double(stage.world().elementCount(slot)) - 4000.0;
    // 4000 draws of 3.5 with probability 1/4: 3500; deviation sqrt(4000 (13.5 / 4 - 0.875^2)) = 102
    EXPECT_NEAR(born, 3500.0, 4.0 * 102.0);
}

TEST(EmitterEvents, birthsBeyondTheCapacityAreCounted)
{
    auto parents = burstEmitter(100);
    parents->events = {ruleOf(EventKind::Birth, 1, 3)};
    auto marks = fedEmitter();
    marks->maxParticles = 50;
    Stage stage;
    const Slot slot = stage.add({}, linkedEffect(std::move(parents), std::move(marks)));
    stage.step();
    EXPECT_EQ(stage.world().elementCount(slot), 150u);
    EXPECT_EQ(stage.counters().born, 400u);
    EXPECT_EQ(stage.counters().dropped, 250u);
}

TEST(EmitterEvents, aDeathCountsAlthoughItsRowIsTakenInTheSameStep)
{
    auto parents = rateEmitter(100.0f, 0.1f); // ten rows for ten alive
    parents->maxParticles = 11;
    parents->events = {ruleOf(EventKind::Death, 1)};
    auto marks = fedEmitter();
    Stage stage;
    const Slot slot = stage.add({}, linkedEffect(std::move(parents), std::move(marks)));
    stage.play(120);
    const uint64_t parentsBorn = (stage.counters().born + 10) / 2; // the last ten live
    EXPECT_NEAR(double(parentsBorn), 200.0, 1.0);
    EXPECT_NEAR(double(stage.world().elementCount(slot)), 200.0, 2.0);
}

TEST(EmitterEvents, emittersWithEventsDoNotSeek)
{
    const auto effect = thrown(ruleOf(EventKind::Death, 1), 1.0f);
    base::SnapshotSchema schema;
    base::HostMemory memory;
    const InstanceParameters parameters;
    StepContext context{};
    context.parameters = &parameters;
    for (const auto& def : effect->solvers)
        EXPECT_FALSE(def->create(schema, {}, &memory)->seekable()->canSeek(context, kTicksPerSecond));
}

TEST(EventBoard, isReadInTheOrderOfTicks)
{
    base::HostMemory memory;
    base::Arena arena(&memory);
    EventBoard board(arena, 1, 2, [](size_t) { return 1u; });
    const auto at = [](base::Ticks tick, uint32_t rule) {
        EventBirth birth{};
        birth.cause.tick = tick;
        birth.rule = rule;
        birth.count = 1;
        return birth;
    };
    for (const EventBirth& birth : {at(5, 0), at(1, 0), at(3, 0), at(1, 1)})
        board.post(1, birth);
    base::WorkBudget unlimited;
    ASSERT_TRUE(board.order(1, unlimited));
    const auto read = board.read(1).births;
    ASSERT_EQ(read.size(), 4u);
    EXPECT_EQ(read[0].cause.tick, 1);
    EXPECT_EQ(read[0].rule, 0u);
    EXPECT_EQ(read[1].rule, 1u);
    EXPECT_EQ(read[3].cause.tick, 5);
    EXPECT_TRUE(board.read(0).births.empty());
}

TEST(EventBoard, keepsTheFirstEventsThatFillTheRoomAndCountsAll)
{
    base::HostMemory memory;
    base::Arena arena(&memory);
    constexpr uint32_t kRoom = 2 * kMinEventBirths, kCount = 100, kEvents = 5000;
    EventBoard board(arena, 1, 1, [](size_t) { return kRoom; });
    for (uint32_t i = 0; i < kEvents; ++i) {
        EventBirth birth{};
        birth.cause.tick = base::Ticks(i * 7919u % kEvents); // each once, in no order
        birth.count = kCount;
        board.post(0, birth);
    }
    for (base::WorkBudget work(1000); !board.order(0, work); work = base::WorkBudget(1000))
        EXPECT_TRUE(work.isSpent());
    const EventRequests requests = board.read(0);
    EXPECT_EQ(requests.asked, uint64_t(kEvents) * kCount);
    ASSERT_EQ(requests.births.size(), (kRoom + kCount - 1) / kCount);
    for (size_t i = 0; i < requests.births.size(); ++i)
        EXPECT_EQ(requests.births[i].cause.tick, base::Ticks(i));
}

TEST(EmitterEvents, aRepeatedAgeHappensAgainAndAgainForAnySteps)
{
    const auto marksAfter = [](base::Ticks part, bool integrated) {
        auto ball = burstEmitter(1);
        ball->lifetime = {0.9f, 0.9f};
        ball->shape = EmitterShape::Box;
        ball->speed = {2, 2};
        ball->forces.gravity = 0;
        if (integrated)
            ball->modules = {std::make_shared<Idle>()};
        ball->events = {ruleOf(EventKind::Age, 1)};
        ball->events[0].age = kTicksPerSecond / 10;
        ball->events[0].every = kTicksPerSecond / 5;
        Stage stage;
        stage.add({}, linkedEffect(std::move(ball), fedEmitter()));
        for (base::Ticks now = 0; now < 2 * kTicksPerSecond; now += part)
            stage.step(std::min(part, 2 * kTicksPerSecond - now));
        std::vector<float> heights;
        for (const Seen& seen : particlesOf(stage.look(), 1))
            heights.push_back(seen.position.y);
        return heights;
    };
    for (const bool integrated : {false, true})
        for (const base::Ticks part : {kTicksPerSecond / 60, kTicksPerSecond / 7}) {
            const auto heights = marksAfter(part, integrated);
            ASSERT_EQ(heights.size(), 4u); // at 0.1, 0.3, 0.5, 0.7 s; dead at 0.9 s
            for (size_t i = 0; i < 4; ++i)
                EXPECT_NEAR(heights[i], 0.2f + 0.4f * float(i), 1e-4f);
        }
}
