#include "simulation/motion/ground_contact.h"
#include "tests/simulation/stage.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx;
using namespace fx::test;
namespace blob = base::blob_column;

namespace {

constexpr float kGravity = 9.80665f;

/// One particle thrown straight up with 12 m/s.
std::unique_ptr<sim::EmitterDef> thrown()
{
    auto def = burstEmitter(1);
    def->shape = sim::EmitterShape::Box;
    def->speed = {12.0f, 12.0f};
    return def;
}

float column(Stage& stage, size_t index)
{
    return stage.look().group(0).column(index)[0];
}

sim::Slot addOnGround(Stage& stage, std::unique_ptr<sim::EmitterDef> def)
{
    auto effect = std::make_shared<sim::EffectDef>();
    effect->solvers.push_back(std::move(def));
    return stage.add({}, effect);
}

} // namespace

TEST(EmitterMotion, aThrownParticleFollowsTheParabola)
{
    Stage stage;
    stage.add({}, thrown());
    for (int i = 1; i <= 120; ++i) {
        stage.step();
        const float t = float(i) / 60.0f;
        ASSERT_NEAR(column(stage, blob::PositionY), 12.0f * t - 0.5f * kGravity * t * t, 1e-4f * float(i))
            << i;
        ASSERT_NEAR(column(stage, blob::VelocityY), 12.0f - kGravity * t, 1e-4f) << i;
    }
}

TEST(EmitterMotion, dragIsTheExactExponentialWhateverTheStep)
{
    for (const float drag : {0.01f, 1.0f, 30.0f, 1e5f}) {
        Stage stage;
        auto def = thrown();
        def->forces.gravity = 0.0f;
        def->forces.drag = drag;
        stage.add({}, std::move(def));
        stage.play(30);
        const double t = 0.5;
        EXPECT_NEAR(column(stage, blob::VelocityY), 12.0 * std::exp(-double(drag) * t), 2e-5) << drag;
        EXPECT_NEAR(column(stage, blob::PositionY), 12.0 * -std::expm1(-double(drag) * t) / double(drag),
                    2e-5)
            << drag;
    }
}

TEST(EmitterMotion, dragCarriesAlongWithAllTheWinds)
{
    Stage stage;
    auto def = burstEmitter(1);
    def->forces.gravity = 0.0f;
    def->forces.drag = 20.0f;
    def->forces.wind = {1, 0, 0};
    auto effect = std::make_shared<sim::EffectDef>();
    effect->wind = {0, 2, 0};
    effect->solvers.push_back(std::move(def));
    sim::InstanceStart start;
    start.parameters.wind = {0, 0, 3};
    stage.add(start, effect);
    stage.play(120);
    EXPECT_NEAR(column(stage, blob::VelocityX), 1.0f, 1e-5f);
    EXPECT_NEAR(column(stage, blob::VelocityY), 2.0f, 1e-5f);
    EXPECT_NEAR(column(stage, blob::VelocityZ), 3.0f, 1e-5f);
    EXPECT_NEAR(column(stage, blob::PositionX), 2.0f - 0.05f, 1e-4f); // behind by 1 / drag
}

TEST(EmitterMotion, buoyancyBalancesGravityAtTwiceTheAirsTemperature)
{
    Stage stage;
    auto def = burstEmitter(1);
    def->temperature = {2.0f * sim::kAirTemperature, 2.0f * sim::kAirTemperature};
    def->forces.buoyancy = 1.0f;
    stage.add({}, std::move(def));
    stage.play(60);
    EXPECT_NEAR(column(stage, blob::VelocityY), 0.0f, 1e-5f);
}

TEST(EmitterMotion, aParticleBornWithinAStepMovesOnlyForTheRestOfIt)
{
    Stage stage;
    auto def = thrown();
    def->forces.gravity = 0.0f;
    def->emission.bursts = {{0.75f / 60.0f, 1}};
    stage.add({}, std::move(def));
    stage.step();
    EXPECT_NEAR(column(stage, blob::PositionY), 12.0f * 0.25f / 60.0f, 1e-6f);
    EXPECT_NEAR(column(stage, blob::Age), 0.25f / 60.0f, 1e-7f);
}

TEST(EmitterMotion, particlesOfAStreamAreSpacedEvenlyAtAnyRate)
{
    Stage stage;
    auto def = rateEmitter(240.0f);
    def->shape = sim::EmitterShape::Box;
    def->speed = {6.0f, 6.0f};
    def->forces.gravity = 0.0f;
    stage.add({}, std::move(def));
    stage.play(30);
    const auto y = stage.look().group(0).column(blob::PositionY);
    ASSERT_EQ(y.size(), 120u);
    for (size_t i = 1; i < y.size(); ++i)
        ASSERT_NEAR(y[i - 1] - y[i], 6.0f / 240.0f, 1e-5f) << i;
}

TEST(EmitterMotion, nothingSinksBelowTheGroundAndRestingStaysAtRest)
{
    Stage stage;
    auto def = thrown();
    def->forces.bounce = 0.5f;
    addOnGround(stage, std::move(def));
    float highest = 0;
    for (int i = 0; i < 1200; ++i) {
        stage.step();
        ASSERT_GE(column(stage, blob::PositionY), 0.0f) << i;
        highest = i > 600 ? std::max(highest, column(stage, blob::PositionY)) : 0.0f;
    }
    EXPECT_LT(highest, 0.01f);
}

TEST(EmitterMotion, aBounceReturnsToTheSquareOfTheRestitutionInHeight)
{
    Stage stage;
    auto def = burstEmitter(1);
    def->position = {0, 4, 0};
    def->forces.bounce = 0.8f;
    addOnGround(stage, std::move(def));
    float top = 0;
    for (int i = 0; i < 120; ++i) {
        stage.step();
        if (column(stage, blob::VelocityY) > 0.0f)
            top = std::max(top, column(stage, blob::PositionY));
    }
    EXPECT_NEAR(top, 4.0f * 0.64f, 0.06f);
}

TEST(EmitterMotion, withoutBounceParticlesPassTheGround)
{
    Stage stage;
    addOnGround(stage, burstEmitter(1));
    stage.play(60);
    EXPECT_LT(column(stage, blob::PositionY), -4.0f);
}

TEST(GroundContact, aFastFallDoesNotTunnel)
{
    const sim::MotionState before{{0, 1, 0}, {0, -1000, 0}};
    const sim::MotionState after{{0, -9, 0}, {0, -1000, 0}};
    const sim::MotionState hit = sim::bounce(before, after, 0.01f, {0.0f, 1.0f, 0.0f});
    EXPECT_NEAR(hit.position.y, 9.0f, 1e-4f); // 1 m down, 9 m up again
    EXPECT_NEAR(hit.velocity.y, 1000.0f, 1e-2f);
}

TEST(GroundContact, frictionTakesItsShareOfWhatSlides)
{
    const sim::MotionState before{{0, 1, 0}, {8, -10, 4}};
    const sim::MotionState after{{1.6f, -1, 0.8f}, {8, -10, 4}};
    const sim::MotionState hit = sim::bounce(before, after, 0.2f, {0.0f, 0.5f, 0.25f});
    EXPECT_EQ(hit.velocity, glm::vec3(6, 5, 3));
    EXPECT_NEAR(hit.position.x, 0.8f + 0.6f, 1e-6f); // half the way at 8 m/s, half at 6
}

TEST(GroundContact, aParticleThatStartsBelowIsPutOntoTheGround)
{
    const sim::MotionState below{{0, -2, 0}, {0, -1, 0}};
    const sim::MotionState deeper{{0, -2.1f, 0}, {0, -1, 0}};
    EXPECT_GE(sim::bounce(below, deeper, 0.1f, {0.0f, 0.5f, 0.0f}).position.y, 0.0f);
}
