// Instances that follow the paths of moving objects, whose poses a host states at a rate of its own.
#include "tests/api/motion_fixture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace fx::test;

constexpr double kSecond = kTicksASecond;

/// Particles that fly on with the velocity of the instance.
constexpr const char* kThrown =
    R"({"version": 1, "name": "thrown", "ground": false, "emitters": [{"maxParticles": 400,
    "space": "world", "inheritVelocity": 1, "emission": {"rate": 60}, "lifetime": 3, "forces": {"gravity": 0},
    "radius": 0.01}]})";

class MotionApi : public MotionTest
{};

/// The frames of a host that is neither fast nor even.
double unevenFrame(int i)
{
    return 0.004 + 0.03 * double(i * 7 % 11) / 10.0;
}

} // namespace

TEST_F(MotionApi, aStraightLineIsExactAtAnyFrameRate)
{
    const Path line;
    for (const double rate : {30.0, 60.0, 144.0, 0.0}) {
        seconds_ = 0.0;
        FxScene* const before = scene_;
        const FxSceneDef def = fxDefaultSceneDef();
        ASSERT_EQ(fxCreateScene(context_, &def, &scene_), FX_OK);
        const FxInstanceId id = follow(line, "local");
        for (int i = 0; i < 100; ++i) {
            frame(id, line, rate > 0.0 ? 1.0 / rate : unevenFrame(i));
            ASSERT_LT(error(line), 2e-6) << rate << ", frame " << i;
        }
        ASSERT_EQ(fxDestroyScene(scene_), FX_OK);
        scene_ = before;
    }
}

TEST_F(MotionApi, aRotorIsOnItsCircleAtTicks)
{
    struct Case
    {
        double rate;
        bool hasVelocity;
        double most; ///< [m] of 1 m: h^4 / 384 with velocities, h^2 / 8 without, h the angle in a frame
    };
    for (const Case& one : {Case{30, true, 9e-5}, {30, false, 0.0225}, {144, true, 1e-6}, {144, false, 1e-3}})
    {
        seconds_ = 0.0;
        FxScene* const before = scene_;
        const FxSceneDef def = fxDefaultSceneDef();
        ASSERT_EQ(fxCreateScene(context_, &def, &scene_), FX_OK);
        const Path rotor{true, one.hasVelocity};
        const FxInstanceId id = follow(rotor, "local");
        double most = 0.0;
        for (int i = 0; i < int(one.rate); ++i) {
            frame(id, rotor, 1.0 / one.rate);
            most =
                std::max(most, error(rotor, 1.01 / one.rate)); // the first pose is reached on a straight path
        }
        std::printf("rotor of 1 m, %.0f poses a second%s: %.2g m\n", one.rate,
                    one.hasVelocity ? " with velocities" : "", most);
        EXPECT_LT(most, one.most);
        ASSERT_EQ(fxDestroyScene(scene_), FX_OK);
        scene_ = before;
    }
}

TEST_F(MotionApi, birthsOfAFastObjectAreEven)
{
    for (const double rate : {30.0, 144.0, 0.0})
        for (const bool byTransform : {false, true}) {
            seconds_ = 0.0;
            FxScene* const before = scene_;
            const FxSceneDef def = fxDefaultSceneDef();
            ASSERT_EQ(fxCreateScene(context_, &def, &scene_), FX_OK);
            const Path line{false, true};
            const FxInstanceId id = follow(line, "world");
            for (int i = 0; seconds_ < 1.0; ++i)
                frame(id, line, rate > 0.0 ? 1.0 / rate : unevenFrame(i), byTransform);
            const double uneven = unevenness();
            std::printf("%.0f Hz by %s: distances of births differ by %.3f\n", rate,
                        byTransform ? "fxScene_SetTransform" : "fxScene_SetMotion", uneven);
            if (!byTransform) {
                EXPECT_LT(uneven, 1.01) << rate;
            } else if (rate != 30.0) { // of which each frame has two steps
                EXPECT_GT(uneven, 1.3) << rate;
            }
            ASSERT_EQ(fxDestroyScene(scene_), FX_OK);
            scene_ = before;
        }
}

TEST_F(MotionApi, birthsOfARotorAreWithinTheChordsOfSteps)
{
    const Path rotor{true, true};
    const FxInstanceId id = follow(rotor, "world");
    for (int i = 0; i < 30; ++i)
        frame(id, rotor, 1.0 / 30.0);
    double most = 0.0;
    const std::vector<Point> all = births();
    for (size_t i = 60; i < all.size(); ++i)
        most = std::max(most, std::abs(std::hypot(all[i][0], all[i][2]) - 1.0));
    EXPECT_LT(most, kStepTurn * kStepTurn / 8.0 + 1e-4);
    EXPECT_GT(most, 0.5 * kStepTurn * kStepTurn / 8.0);
}

TEST_F(MotionApi, posesAreASavedStateAndAPartOfTheHash)
{
    const Path rotor{true, true};
    const FxInstanceId id = follow(rotor, "world");
    for (int i = 0; i < 20; ++i)
        frame(id, rotor, 1.0 / 144.0);
    const uint64_t before = simulationHash();
    const std::vector<std::byte> state = savedState();
    const double then = seconds_;
    for (int i = 0; i < 40; ++i)
        frame(id, rotor, 1.0 / 144.0);
    const uint64_t wanted = simulationHash(), shown = hash();
    ASSERT_EQ(restore(state), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(simulationHash(), before);
    seconds_ = then;
    for (int i = 0; i < 40; ++i)
        frame(id, rotor, 1.0 / 144.0);
    EXPECT_EQ(simulationHash(), wanted);
    EXPECT_EQ(hash(), shown);

    ASSERT_EQ(restore(state), FX_OK);
    FxMotion pose = rotor.at(then + 1.0);
    pose.tick = int64_t((then + 1.0) * kSecond);
    ASSERT_EQ(fxScene_SetMotion(scene_, id, &pose), FX_OK);
    EXPECT_NE(simulationHash(), before); // later steps depend on it
}

TEST_F(MotionApi, stepsOfPosesInTheFutureFollowThemWhileTheHostIsSilent)
{
    const Path line;
    const FxInstanceId id = follow(line, "local");
    FxMotion pose = line.at(0.5);
    pose.aheadSeconds = 0.5;
    ASSERT_EQ(fxScene_SetMotion(scene_, id, &pose), FX_OK);
    for (int i = 0; i < 60; ++i) {
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
        if (i < 30) {
            EXPECT_LT(error(line), 1e-6) << i;
        } else {
            EXPECT_LT(distance(placed(), line.point(0.5)), 1e-6) << i;
        }
    }
}

TEST_F(MotionApi, aTransformEndsAMotion)
{
    const Path line;
    const FxInstanceId id = follow(line, "local");
    frame(id, line, kFrame);
    FxMotion far = line.at(10.0);
    far.aheadSeconds = 1.0;
    ASSERT_EQ(fxScene_SetMotion(scene_, id, &far), FX_OK);
    const double here[3] = {1, 2, 3};
    const float upright[4] = {0, 0, 0, 1};
    ASSERT_EQ(fxScene_SetTransform(scene_, id, here, upright, 1.0f), FX_OK);
    play(3);
    EXPECT_EQ(placed(), (Point{1, 2, 3}));
    FxMotion pose = fxDefaultMotion();
    ASSERT_EQ(fxScene_SetMotion(scene_, id, &pose), FX_OK);
    ASSERT_EQ(fxScene_DestroyInstance(scene_, id), FX_OK);
    EXPECT_EQ(fxScene_SetMotion(scene_, id, &pose), FX_ERROR_STALE_ID);
    play(3);
}

TEST_F(MotionApi, anInstanceOutOfSightHasThePathOfOneInSight)
{
    const Path rotor{true, true};
    FxScene* const seen = scene_;
    FxSceneDef def = fxDefaultSceneDef();
    def.lockStep = 1;
    FxScene* unseen = nullptr;
    ASSERT_EQ(fxCreateScene(context_, &def, &unseen), FX_OK);
    FxFocus away = fxDefaultFocus();
    away.origin[2] = 1e4;
    away.maxDistance = 100.0;
    away.projection[0] = away.projection[5] = 1.0f;
    away.projection[10] = away.projection[11] = -1.0f; // infinite
    away.projection[14] = -0.1f;
    uint64_t hashes[2] = {};
    for (FxScene* const scene : {seen, unseen}) {
        scene_ = scene;
        seconds_ = 0.0;
        const FxInstanceId id = follow(rotor, "world");
        bool wasHidden = false;
        for (int i = 0; i < 60; ++i) {
            if (i == 10 && scene == unseen) {
                ASSERT_EQ(fxScene_SetFocus(scene_, &away, 1), FX_OK) << fxGetLastErrorMessage();
            }
            frame(id, rotor, 1.0 / 50.0);
            FxInstanceState state{};
            ASSERT_EQ(fxScene_GetInstanceState(scene_, id, &state, nullptr), FX_OK);
            wasHidden = wasHidden || state == FX_INSTANCE_HIDDEN;
        }
        EXPECT_EQ(wasHidden, scene == unseen);
        hashes[scene == unseen] = simulationHash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    ASSERT_EQ(fxDestroyScene(unseen), FX_OK);
    scene_ = seen;
}

TEST_F(MotionApi, unitsAndAxesOfTheHostApply)
{
    FxContextDef world = fxDefaultContextDef();
    world.workers = 1;
    world.unitsPerMeter = 100.0; // left-handed, z up, as Unreal Engine
    world.rightAxis = FX_AXIS_Y;
    world.upAxis = FX_AXIS_Z;
    world.forwardAxis = FX_AXIS_X;
    FxContext* context = nullptr;
    ASSERT_EQ(fxCreateContext(&world, &context), FX_OK);
    const FxSceneDef def = fxDefaultSceneDef();
    FxScene* scene = nullptr;
    ASSERT_EQ(fxCreateScene(context, &def, &scene), FX_OK);
    FxInstanceDef instance = fxDefaultInstanceDef();
    instance.preset = fx::test::loadText(context, trailPreset("local"));
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK);
    FxMotion hub = fxDefaultMotion(); // turns about its up axis z
    hub.hasVelocity = 1;
    const double arm[3] = {100.0, 0.0, 0.0};
    double most = 0.0;
    for (int i = 1; i <= 30; ++i) {
        const double t = double(i) / 30.0;
        hub.rotation[2] = float(std::sin(0.5 * kSpin * t));
        hub.rotation[3] = float(std::cos(0.5 * kSpin * t));
        hub.angularVelocity[2] = float(kSpin);
        hub.tick = int64_t(std::llround(t * kSecond));
        FxMotion tip = fxDefaultMotion();
        ASSERT_EQ(fxOffsetMotion(&hub, arm, nullptr, &tip), FX_OK);
        ASSERT_EQ(fxScene_SetMotion(scene, id, &tip), FX_OK) << fxGetLastErrorMessage();
        ASSERT_EQ(fxScene_Update(scene, 1.0 / 30.0), FX_OK);
        FxSnapshotId held{};
        ASSERT_EQ(fxScene_AcquireSnapshot(scene, &held), FX_OK);
        FxSnapshotInfo info{};
        info.structSize = sizeof info;
        ASSERT_EQ(fxScene_GetSnapshotInfo(scene, held, &info), FX_OK);
        for (const FxSnapshotStep step : {FX_SNAPSHOT_OLDER, FX_SNAPSHOT_NEWER}) {
            FxSnapshotGroup group{};
            group.structSize = sizeof group;
            ASSERT_EQ(fxScene_GetSnapshotGroup(scene, held, step, 0, &group), FX_OK);
            const double end = double(step == FX_SNAPSHOT_OLDER ? info.tickOlder : info.tickNewer) / kSecond;
            const Point wanted{100.0 * std::cos(kSpin * end), 100.0 * std::sin(kSpin * end), 0.0};
            if (i > 1)
                most = std::max(most,
                                distance({group.position[0], group.position[1], group.position[2]}, wanted));
        }
        ASSERT_EQ(fxScene_ReleaseSnapshot(scene, held), FX_OK);
    }
    EXPECT_LT(most, 9e-3); // cm, as of a rotor in meters
    ASSERT_EQ(fxDestroyContext(context), FX_OK);
}

TEST_F(MotionApi, theMotionOfABoneCarriesAnOffsetWithRotationScaleAndVelocity)
{
    FxMotion bone = fxDefaultMotion();
    bone.position[0] = 10.0;
    bone.scale = 2.0f;
    bone.rotation[1] = bone.rotation[3] = float(std::numbers::sqrt2 / 2.0); // a quarter turn about y
    bone.linearVelocity[2] = 3.0f;
    bone.angularVelocity[1] = 5.0f;
    bone.tick = 77;
    bone.hasVelocity = 1;
    const double offset[3] = {0.0, 0.0, 1.0}; // to +x
    const float roll[4] = {0.0f, 0.0f, 1.0f, 0.0f};
    FxMotion tip = fxDefaultMotion();
    ASSERT_EQ(fxOffsetMotion(&bone, offset, roll, &tip), FX_OK) << fxGetLastErrorMessage();
    EXPECT_NEAR(tip.position[0], 12.0, 1e-6);
    EXPECT_NEAR(tip.position[2], 0.0, 1e-6);
    EXPECT_NEAR(tip.linearVelocity[0], 0.0, 1e-5);
    EXPECT_NEAR(tip.linearVelocity[2], 3.0 - 10.0, 1e-5); // 5 rad/s about y, 2 m to +x
    EXPECT_NEAR(tip.rotation[0], std::numbers::sqrt2 / 2.0, 1e-6);
    EXPECT_NEAR(tip.rotation[2], std::numbers::sqrt2 / 2.0, 1e-6);
    EXPECT_EQ(tip.scale, 2.0f);
    EXPECT_EQ(tip.tick, 77);
    EXPECT_EQ(tip.hasVelocity, 1u);
    ASSERT_EQ(fxOffsetMotion(&bone, offset, roll, &bone), FX_OK); // in place
    EXPECT_EQ(bone.position[0], tip.position[0]);
}

TEST_F(MotionApi, aPoseReplacesThoseAtItsTimeAndLater)
{
    const Path line;
    const FxInstanceId id = follow(line, "local");
    double host = 0.0; // the clock of the host, which loses nothing in long frames
    const auto frameOf = [&](double dt) {
        host += dt;
        FxMotion motion = line.at(host);
        motion.aheadSeconds = dt;
        ASSERT_EQ(fxScene_SetMotion(scene_, id, &motion), FX_OK) << fxGetLastErrorMessage() << ", " << host;
        ASSERT_EQ(fxScene_Update(scene_, dt), FX_OK);
    };
    for (int i = 0; i < 10; ++i)
        frameOf(kFrame);
    frameOf(2.0); // the scene adds 1/15 s
    for (int i = 0; i < 30; ++i)
        frameOf(1.0 / 144.0);
    const double lost = host - double(statistics().nowTick) / kSecond;
    EXPECT_GT(lost, 1.9);
    const double shown = double(statistics().simulatedTick) / kSecond;
    EXPECT_LT(distance(placed(), line.point(shown + lost)), 1e-5);
    for (const double dt : {0.0, 0.0, 1e-9, 0.0, 1.0 / 77.0, 0.0})
        frameOf(dt);
    FxMotion early = line.at(0.0);
    early.tick = 1; // before all poses
    ASSERT_EQ(fxScene_SetMotion(scene_, id, &early), FX_OK) << fxGetLastErrorMessage();
    play(2);
    EXPECT_LT(distance(placed(), line.point(0.0)), 1e-6);
}

TEST_F(MotionApi, posesInTheFutureAreKeptAndTheNinthIsRefused)
{
    constexpr double kLeg = 0.1; // [s] from x = 0 to x = 1 and back
    const auto zigzag = [](double t) {
        const double leg = std::floor(t / kLeg), way = t / kLeg - leg;
        return int(leg) % 2 == 0 ? way : 1.0 - way;
    };
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = fx::test::loadText(context_, trailPreset("local"));
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
    const auto add = [&](int leg) {
        FxMotion pose = fxDefaultMotion();
        pose.position[0] = double(leg % 2);
        pose.tick = int64_t(leg) * FX_TICKS_PER_SECOND / 10;
        return fxScene_SetMotion(scene_, id, &pose);
    };
    for (int leg = 1; leg <= FX_MOTION_POSES; ++leg)
        ASSERT_EQ(add(leg), FX_OK) << fxGetLastErrorMessage();
    const uint64_t before = simulationHash();
    EXPECT_EQ(add(FX_MOTION_POSES + 1), FX_ERROR_CAPACITY);
    EXPECT_EQ(simulationHash(), before);
    for (int i = 1; i < 54; ++i) {
        if (i == 10) { // the first pose is past
            EXPECT_EQ(add(FX_MOTION_POSES + 1), FX_OK) << fxGetLastErrorMessage();
            EXPECT_EQ(add(FX_MOTION_POSES + 2), FX_ERROR_CAPACITY);
        }
        play(1);
        EXPECT_NEAR(placed()[0], zigzag(double(statistics().simulatedTick) / kSecond), 1e-6) << i;
    }
}

TEST_F(MotionApi, aSceneThatFallsBehindStaysOnThePath)
{
    FxScene* const before = scene_;
    FxSceneDef def = fxDefaultSceneDef();
    def.workBudget = 1; // one step in an update, of the two that are due
    ASSERT_EQ(fxCreateScene(context_, &def, &scene_), FX_OK);
    const Path line;
    const FxInstanceId id = follow(line, "local");
    for (int i = 0; i < 60; ++i) {
        frame(id, line, 1.0 / 30.0);
        ASSERT_LT(error(line), 1e-5) << i;
    }
    EXPECT_GT(statistics().nowTick - statistics().simulatedTick, FX_TICKS_PER_SECOND / 2);
    ASSERT_EQ(fxDestroyScene(scene_), FX_OK);
    scene_ = before;
}

TEST_F(MotionApi, theReachHasTheParticlesThatFlyOn)
{
    const Path line;
    const FxInstanceId id = followWith(kThrown, line);
    double most = 0.0;
    for (int i = 0; i < 120; ++i) {
        if (i < 30) {
            frame(id, line, kFrame);
        } else { // it has stopped
            play(1);
        }
        double farthest = 0.0;
        const Point stands = line.point(std::min(i + 1, 30) * kFrame);
        for (const Point& point : births())
            farthest = std::max(farthest, distance(point, stands));
        FxInstanceActivity activity{};
        activity.structSize = sizeof activity;
        ASSERT_EQ(fxScene_GetInstanceActivity(scene_, id, &activity), FX_OK);
        EXPECT_GE(double(activity.reach), farthest) << i;
        EXPECT_LT(activity.reach, 1000.0f) << i;
        most = std::max(most, farthest);
    }
    EXPECT_GT(most, 40.0);
}

TEST_F(MotionApi, anInstanceThatStartsWithinAStepIsOnThePath)
{
    const Path line;
    const double start = 3.5 * kFrame;
    for (const char* const space : {"local", "world"}) {
        FxScene* const before = scene_;
        const FxSceneDef def = fxDefaultSceneDef();
        ASSERT_EQ(fxCreateScene(context_, &def, &scene_), FX_OK);
        const FxInstanceId id = follow(line, space, int64_t(start * kSecond));
        FxMotion pose = line.at(0.5);
        pose.aheadSeconds = 0.5;
        ASSERT_EQ(fxScene_SetMotion(scene_, id, &pose), FX_OK) << fxGetLastErrorMessage();
        play(4);
        EXPECT_LT(distance(placed(), line.point(4.0 * kFrame)), 1e-5) << space; // home, of the world
        play(1);
        const std::vector<Point> all = births();
        EXPECT_LT(distance(all.back(), all[all.size() - 2]), 1.01 * line.speed() / 600.0) << space;
        ASSERT_EQ(fxDestroyScene(scene_), FX_OK);
        scene_ = before;
    }
}

TEST_F(MotionApi, wrongPosesAreRefusedAndChangeNothing)
{
    const Path line;
    const FxInstanceId id = follow(line, "local");
    frame(id, line, kFrame);
    const uint64_t before = simulationHash();
    const auto refuse = [&](auto&& change, FxResult code = FX_ERROR_INVALID_ARGUMENT) {
        FxMotion motion = line.at(1.0);
        change(motion);
        EXPECT_EQ(fxScene_SetMotion(scene_, id, &motion), code) << fxGetLastErrorMessage();
        EXPECT_EQ(simulationHash(), before);
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    refuse([](FxMotion& m) { m.structSize = 3; }, FX_ERROR_VERSION);
    refuse([](FxMotion& m) { m.scale = 0.0f; });
    refuse([](FxMotion& m) { m.scale = kNan; });
    refuse([](FxMotion& m) { m.position[1] = 2e9; });
    refuse([](FxMotion& m) { m.position[1] = double(kNan); });
    refuse([](FxMotion& m) { m.rotation[0] = 1.0f; });
    refuse([](FxMotion& m) { m.linearVelocity[2] = 2e6f; });
    refuse([](FxMotion& m) { m.angularVelocity[0] = kNan; });
    refuse([](FxMotion& m) { m.aheadSeconds = -1.0; });
    refuse([](FxMotion& m) { m.aheadSeconds = 3601.0; });
    refuse([](FxMotion& m) { m.tick = -1; });
    refuse([](FxMotion& m) { m.tick = 4000 * FX_TICKS_PER_SECOND; });
    refuse([](FxMotion& m) { m.hasVelocity = 2; });
    refuse([](FxMotion& m) { m.reserved = 1; });
    EXPECT_EQ(fxScene_SetMotion(scene_, id, nullptr), FX_ERROR_INVALID_ARGUMENT);
    const FxMotion motion = line.at(1.0);
    EXPECT_EQ(fxScene_SetMotion(nullptr, id, &motion), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetMotion(scene_, FxInstanceId{}, &motion), FX_ERROR_STALE_ID);
    const double offset[3] = {0, 0, 0}, endless[3] = {0, std::numeric_limits<double>::infinity(), 0};
    const float none[4] = {0, 0, 0, 0};
    FxMotion out = fxDefaultMotion();
    EXPECT_EQ(fxOffsetMotion(nullptr, offset, nullptr, &out), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxOffsetMotion(&motion, nullptr, nullptr, &out), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxOffsetMotion(&motion, endless, nullptr, &out), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxOffsetMotion(&motion, offset, none, &out), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxOffsetMotion(&motion, offset, nullptr, nullptr), FX_ERROR_INVALID_ARGUMENT);
    out.structSize = 5;
    EXPECT_EQ(fxOffsetMotion(&motion, offset, nullptr, &out), FX_ERROR_VERSION);
}
