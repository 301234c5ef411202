// How far an instance is said to reach while the host moves it and changes the wind, against where its
// particles are.
#include "fxsdk/scene/motion_history.h"
#include "simulation/world/instance_clock.h"
#include "tests/api/sight_stage.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kSecond = 60; ///< [step]

/// Sparks that stay where they are left.
Effect torch(float inherited)
{
    Effect effect = fountainEffect();
    auto& emitter = const_cast<sim::EmitterDef&>(static_cast<const sim::EmitterDef&>(*effect->solvers[0]));
    emitter.inWorld = true;
    emitter.inheritVelocity = inherited;
    emitter.position = {0.3f, 0, 0};
    effect->hasGround = false;
    return effect;
}

/// [m] from the instance's place to the farthest of what is shown of it.
double farthest(scene::Scene& scene, const glm::dvec3& place)
{
    const scene::Presentation shown = scene.acquire();
    double most = 0;
    for (const base::FrameSnapshot* snapshot : {shown.snapshots.newer, shown.snapshots.older})
        for (size_t g = 0; snapshot && g < snapshot->groupCount(); ++g) {
            const base::SnapshotGroup& group = snapshot->group(g);
            const base::Placement& at = group.info().placement;
            for (uint32_t i = 0; i < group.count(); ++i) {
                const glm::vec3 local(group.column(base::blob_column::PositionX)[i],
                                      group.column(base::blob_column::PositionY)[i],
                                      group.column(base::blob_column::PositionZ)[i]);
                const glm::dvec3 world = at.position + glm::dvec3(at.rotation * (at.scale * local));
                const float radius = at.scale * group.column(base::blob_column::Radius)[i];
                most = std::max(most, glm::length(world - place) + double(radius));
            }
        }
    scene.release(shown.snapshots);
    return most;
}

/// Carries an instance in a circle that turns into a line, turning and swelling on the way.
base::Placement onTheWay(int step)
{
    base::Placement placement;
    const float t = float(step) / float(kSecond);
    placement.position = {5.0 * double(t), 0, step < 4 * kSecond ? std::sin(3.0 * double(t)) : 0.0};
    placement.rotation = glm::angleAxis(0.7f * t, glm::vec3(0, 1, 0));
    placement.scale = 1.0f + 0.3f * std::sin(t);
    return placement;
}

} // namespace

TEST(MotionHistory, whatIsCarriedReachesToAllThatItLeavesBehind)
{
    for (const float inherited : {0.0f, 1.0f}) {
        SightStage stage(neverCulled());
        const auto id = stage.add(torch(inherited), glm::dvec3(0.0));
        double most = 0;
        for (int i = 1; i < 12 * kSecond; ++i) {
            const base::Placement placement = onTheWay(i);
            stage.scene().setPlacement(id, placement);
            stage.play(1);
            const double reach = stage.scene().activity(id).reach;
            ASSERT_LE(farthest(stage.scene(), placement.position), reach) << i;
            most = std::max(most, reach);
        }
        EXPECT_LT(most, inherited > 0.0f ? 40.0 : 16.0); // of 60 m that it went
    }
}

TEST(MotionHistory, aTorchThatStandsReachesAsFarAsOneThatCannotBeCarried)
{
    SightStage stage;
    const auto carried = stage.add(torch(1.0f), kAhead);
    Effect fixed = torch(0.0f);
    const_cast<sim::EmitterDef&>(static_cast<const sim::EmitterDef&>(*fixed->solvers[0])).inWorld = false;
    const auto standing = stage.add(fixed, kAhead);
    EXPECT_EQ(stage.scene().activity(carried).reach, stage.scene().activity(standing).reach);
    EXPECT_LT(stage.scene().activity(carried).reach, 3.0);
}

TEST(MotionHistory, whatIsCarriedOutOfSightComesBackAsIfItHadNeverBeenHidden)
{
    SightStage stage, always(neverCulled());
    const Effect effect = torch(0.5f);
    const auto id = stage.add(effect, kAhead), other = always.add(effect, kAhead);
    int hidden = 0;
    const auto carry = [&](int step) {
        base::Placement placement;
        placement.position = kAhead + glm::dvec3(0.02 * step, 0, 0);
        stage.scene().setPlacement(id, placement);
        always.scene().setPlacement(other, placement);
        stage.play(1);
        always.play(1);
        hidden += stage.state(id) == scene::InstanceState::Hidden;
    };
    for (int i = 0; i < 30; ++i)
        carry(i);
    stage.look(kBehind);
    for (int i = 30; i < 75; ++i)
        carry(i);
    EXPECT_GT(hidden, 30);
    stage.look(0);
    carry(75);
    EXPECT_EQ(stage.scene().simulationHash(), always.scene().simulationHash());
    EXPECT_EQ(stage.scene().stateHash(), always.scene().stateHash());
}

TEST(MotionHistory, whatAStormHasBlownAwayIsReachedUntilItIsGone)
{
    SightStage stage(neverCulled());
    Effect effect = fountainEffect(false, 2.0f);
    auto& emitter = const_cast<sim::EmitterDef&>(static_cast<const sim::EmitterDef&>(*effect->solvers[0]));
    emitter.forces.drag = 5;
    emitter.forces.gravity = 0;
    const auto id = stage.add(effect, glm::dvec3(0.0));
    const double calm = stage.scene().activity(id).reach;
    sim::InstanceParameters parameters;
    parameters.wind = {30, 0, 0};
    stage.scene().setParameters(id, parameters);
    stage.play(2 * kSecond);
    parameters.wind = glm::vec3(0.0f);
    double beyond = 0;
    for (int i = 0; i < 10 * kSecond; ++i) {
        stage.scene().setParameters(id, parameters); // looks at the time
        stage.play(1);
        const double most = farthest(stage.scene(), glm::dvec3(0.0));
        ASSERT_LE(most, stage.scene().activity(id).reach) << i;
        beyond = std::max(beyond, most);
    }
    EXPECT_GT(beyond, 2 * calm); // which the wind of now alone would say
    EXPECT_EQ(stage.scene().activity(id).reach, calm);
}

TEST(MotionHistory, afterALifetimeARestoredTorchReachesAsFarAsItCanAgain)
{
    SightStage stage;
    const Effect effect = torch(0.0f);
    const auto id = stage.add(effect, kAhead);
    stage.play(30);
    sim::StateBuffer bytes(std::pmr::get_default_resource());
    stage.scene().save(bytes);
    ASSERT_TRUE(stage.scene().restore(bytes.bytes(), [&](uint64_t) { return effect; }).ok());
    EXPECT_TRUE(std::isinf(stage.scene().activity(id).reach)); // a state does not tell where it has been
    base::Placement placement;
    for (int i = 0; i < 3 * kSecond; ++i) {
        placement.position = kAhead + glm::dvec3(0, 0.001 * i, 0);
        stage.scene().setPlacement(id, placement);
        stage.play(1);
    }
    EXPECT_LT(stage.scene().activity(id).reach, 3.0);
}

TEST(MotionHistory, afterARestoreNobodyKnowsOfAStormUntilItIsGone)
{
    SightStage stage;
    Effect effect = fountainEffect(false, 2.0f);
    auto& emitter = const_cast<sim::EmitterDef&>(static_cast<const sim::EmitterDef&>(*effect->solvers[0]));
    emitter.forces.drag = 5;
    const auto id = stage.add(effect, kAhead);
    sim::InstanceParameters parameters;
    parameters.wind = {30, 0, 0};
    stage.scene().setParameters(id, parameters);
    stage.play(2 * kSecond);
    parameters.wind = glm::vec3(0.0f);
    stage.scene().setParameters(id, parameters);
    sim::StateBuffer bytes(std::pmr::get_default_resource());
    stage.scene().save(bytes);
    ASSERT_TRUE(stage.scene().restore(bytes.bytes(), [&](uint64_t) { return effect; }).ok());
    stage.play(1);
    EXPECT_LE(farthest(stage.scene(), kAhead), stage.scene().activity(id).reach);
    for (int i = 0; i < 10 * kSecond; ++i) {
        stage.look(1e-4 * i); // that a camera looks around is enough
        stage.play(1);
    }
    EXPECT_LT(stage.scene().activity(id).reach, 1e3);
}

TEST(MotionHistory, slowTimeForgetsLater)
{
    scene::MotionHistory normal, slow;
    for (int step = 0; step < 100; ++step) {
        scene::BoundsInputs is;
        is.low = is.high = {double(step), 0, 0};
        is.smallest = is.largest = 1;
        is.slowest = sim::kNormalRate;
        normal.note(step * kStep, is, 0.25f);
        is.slowest = sim::kNormalRate / 4;
        slow.note(step * kStep, is, 0.25f);
    }
    EXPECT_GE(normal.all().low.x, 100.0 - 3.0 * 16); // 15 steps in a quarter of a second
    EXPECT_LE(normal.all().low.x, 99.0 - 15);
    EXPECT_LE(slow.all().low.x, 99.0 - 60);
    EXPECT_EQ(slow.all().high.x, 99.0);
}
