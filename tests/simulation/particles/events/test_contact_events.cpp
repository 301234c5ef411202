// Which contacts are events: as many as the series of a bounce says, whatever the step.
#include "simulation/particles/collisions/collision_op.h"
#include "tests/simulation/particles/events/linked.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;
using base::kTicksPerSecond;

namespace {

constexpr double kGravity = 9.80665;
constexpr int kSeconds = 3;
constexpr int kRates[] = {30, 60, 120, 144}; ///< [1/s] steps

/// Births one after the other until the end and beyond, which fall from `height` on a plane.
std::unique_ptr<EmitterDef> falling(float height, const CollisionDef& plane, const EventRule& rule)
{
    auto ball = rateEmitter(17.0f, 100.0f);
    ball->appearance.kind = AppearanceKind::Sprite;
    ball->position = {0, height, 0};
    ball->maxParticles = 256;
    ball->modules = {makeCollisionOp(std::span(&plane, 1))};
    ball->events = {rule};
    return ball;
}

std::shared_ptr<EffectDef> rain(const CollisionDef& plane, const EventRule& rule)
{
    auto marks = fedEmitter();
    marks->maxParticles = 16'384;
    return linkedEffect(falling(0.004f, plane, rule), falling(1.0f, plane, rule), falling(2.7f, plane, rule),
                        std::move(marks));
}

void play(Stage& stage, int rate)
{
    for (int i = 0; i < kSeconds * rate; ++i)
        stage.step(kTicksPerSecond / rate);
}

/// Contacts of a particle of some age, as the series of its speeds w e^k has them.
size_t contactsOf(double height, double age, double restitution, double least)
{
    const double fall = std::sqrt(2.0 * height / kGravity);
    double speed = kGravity * fall, time = fall;
    size_t count = 0;
    for (; time <= age && speed >= least && speed > 1e-6; ++count) {
        EXPECT_GT(age - time, 1e-5) << "too near to be told";
        EXPECT_GT(std::abs(speed / least - 1.0), 1e-3) << "too near to be told";
        speed *= restitution;
        time += 2.0 * speed / kGravity;
    }
    return count;
}

size_t expectedMarks(const base::FrameSnapshot& now, double restitution, double least)
{
    const double heights[] = {0.004, 1.0, 2.7};
    size_t count = 0;
    for (uint32_t solver = 0; solver < 3; ++solver)
        for (const Seen& seen : particlesOf(now, solver))
            count += contactsOf(heights[solver], double(seen.age), restitution, least);
    return count;
}

CollisionDef planeOf(ContactResponse response, float restitution)
{
    CollisionDef plane;
    plane.response = response;
    plane.restitution = restitution;
    return plane;
}

EventRule contactRule(float least)
{
    EventRule rule = ruleOf(EventKind::Collision, 3);
    rule.minSpeed = least;
    return rule;
}

/// Marks that one particle leaves on a slope, down which it slides far away from the origin.
size_t marksOfSlide(float restitution, float least, int rate)
{
    CollisionDef slope = planeOf(ContactResponse::Bounce, restitution);
    slope.position = {3000, 0, -2000};
    slope.axis = {0.5f, 1, 0};
    auto ball = burstEmitter(1);
    ball->position = {3000, 0.5f, -2000};
    ball->modules = {makeCollisionOp(std::span(&slope, 1))};
    ball->events = {ruleOf(EventKind::Collision, 1)};
    ball->events[0].minSpeed = least;
    Stage stage;
    stage.add({}, linkedEffect(std::move(ball), fedEmitter()));
    play(stage, rate);
    return particlesOf(stage.look(), 1).size();
}

} // namespace

TEST(ContactEvents, areAsManyAsTheSeriesOfABounceSaysForAnyStep)
{
    for (const float restitution : {0.0f, 0.2f, 0.5f, 0.9f})
        for (const float least : {0.05f, kUsualContactSpeed, 2.0f})
            for (const int rate : kRates) {
                Stage stage;
                stage.add({}, rain(planeOf(ContactResponse::Bounce, restitution), contactRule(least)));
                play(stage, rate);
                const base::FrameSnapshot& now = stage.look();
                const size_t want = expectedMarks(now, double(restitution), double(least));
                EXPECT_GT(want, 40u);
                EXPECT_EQ(particlesOf(now, 3).size(), want)
                    << restitution << " from " << least << " m/s, " << rate << " steps/s";
            }
}

TEST(ContactEvents, whoIsHeldTouchesOnceAtAnySpeedUnlessALeastOneIsAskedFor)
{
    for (const float least : {0.0f, kUsualContactSpeed})
        for (const int rate : kRates) {
            EventRule rule = contactRule(kUsualContactSpeed);
            rule.minLastSpeed = least;
            Stage stage;
            stage.add({}, rain(planeOf(ContactResponse::Stick, 0.0f), rule));
            play(stage, rate);
            const base::FrameSnapshot& now = stage.look();
            EXPECT_EQ(particlesOf(now, 3).size(), expectedMarks(now, 0.0, double(least)))
                << least << ", " << rate << " steps/s";
        }
}

TEST(ContactEvents, whoIsKilledTouchesOnce)
{
    std::vector<size_t> counts;
    for (const int rate : kRates) {
        Stage stage;
        const Slot slot = stage.add({}, rain(planeOf(ContactResponse::Kill, 0.0f), contactRule(0.5f)));
        play(stage, rate);
        const size_t marks = particlesOf(stage.look(), 3).size();
        EXPECT_EQ(marks * 2 + (stage.world().elementCount(slot) - marks), stage.counters().born);
        counts.push_back(marks);
    }
    EXPECT_GT(counts[0], 100u);
    EXPECT_EQ(counts, std::vector<size_t>(counts.size(), counts[0]));
}

TEST(ContactEvents, whoSlidesRaisesNoneAlsoFarFromTheOrigin)
{
    for (const int rate : kRates)
        EXPECT_EQ(marksOfSlide(0.0f, 0.05f, rate), 1u) << rate;
}

TEST(ContactEvents, allContactsOfAStepCount)
{
    CollisionDef room;
    room.kind = ObstacleKind::Box;
    room.isHollow = true;
    room.restitution = 1.0f;
    for (const int rate : {10, 30, 144}) {
        auto ball = burstEmitter(1);
        ball->shape = EmitterShape::Box; // upwards
        ball->speed = {38.7f, 38.7f};    // 1 m to the first wall, then 2 m to each
        ball->forces.gravity = 0;
        ball->modules = {makeCollisionOp(std::span(&room, 1))};
        ball->events = {ruleOf(EventKind::Collision, 1)};
        Stage stage;
        stage.add({}, linkedEffect(std::move(ball), fedEmitter()));
        play(stage, rate);
        const auto marks = particlesOf(stage.look(), 1);
        EXPECT_EQ(marks.size(), size_t((38.7 * kSeconds + 1.0) / 2.0)) << rate;
        for (const Seen& mark : marks)
            EXPECT_NEAR(std::abs(mark.position.y), 1.0f, 1e-4f);
    }
}
