// Instances that follow the paths of moving objects, whose poses a host states at a rate of its own.
#include "tests/api/api_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace {

using fx::test::kFrame;
using Point = std::array<double, 3>;

constexpr double kSecond = double(FX_TICKS_PER_SECOND);
constexpr double kTurns = 2.0;                            ///< [1/s] of the rotor
constexpr double kSpin = 2.0 * std::numbers::pi * kTurns; ///< [rad/s]
constexpr double kStepTurn = kSpin * kFrame;              ///< [rad] in a step

/// Particles that stay where they are born, 600 in a second.
std::string trailPreset(const char* space)
{
    return std::string(R"({"version": 1, "name": "trail", "ground": false, "emitters": [{"maxParticles": 4000,
        "space": ")") +
           space +
           R"(", "emission": {"rate": 600}, "lifetime": 100, "forces": {"gravity": 0}, "radius": 0.01}]})";
}

/// A motion in closed form.
struct Path
{
    FxMotion at(double seconds) const
    {
        FxMotion motion = fxDefaultMotion();
        motion.hasVelocity = hasVelocity ? 1 : 0;
        if (!isRotor) {
            const double velocity[3] = {30.0, 4.0, -12.0};
            for (int a = 0; a < 3; ++a) {
                motion.position[a] = 5.0 + velocity[a] * seconds;
                motion.linearVelocity[a] = float(velocity[a]);
            }
            return motion;
        }
        FxMotion hub = motion; // turns about y; the effect is at the end of an arm of 1 m
        hub.position[1] = 2.0;
        hub.rotation[1] = float(std::sin(0.5 * kSpin * seconds));
        hub.rotation[3] = float(std::cos(0.5 * kSpin * seconds));
        hub.angularVelocity[1] = float(kSpin);
        const double arm[3] = {1.0, 0.0, 0.0};
        EXPECT_EQ(fxOffsetMotion(&hub, arm, nullptr, &motion), FX_OK) << fxGetLastErrorMessage();
        return motion;
    }
    Point point(double seconds) const
    {
        if (isRotor)
            return {std::cos(kSpin * seconds), 2.0, -std::sin(kSpin * seconds)};
        return {5.0 + 30.0 * seconds, 5.0 + 4.0 * seconds, 5.0 - 12.0 * seconds};
    }

    bool isRotor = false;
    bool hasVelocity = false;
};

double distance(const Point& a, const Point& b)
{
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

class MotionApi : public fx::test::ApiTest
{
protected:
    FxInstanceId follow(const Path& path, const char* space)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = fx::test::loadText(context_, trailPreset(space));
        const FxMotion start = path.at(0.0);
        std::copy_n(start.position, 3, def.position);
        std::copy_n(start.rotation, 4, def.rotation);
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }
    /// States the pose at the end of a frame of `dt`, then adds this time.
    void frame(FxInstanceId id, const Path& path, double dt, bool byTransform = false)
    {
        seconds_ += dt;
        FxMotion motion = path.at(seconds_);
        motion.tick = int64_t(std::llround(seconds_ * kSecond));
        if (byTransform) {
            ASSERT_EQ(fxScene_SetTransform(scene_, id, motion.position, motion.rotation, 1.0f), FX_OK);
        } else {
            ASSERT_EQ(fxScene_SetMotion(scene_, id, &motion), FX_OK) << fxGetLastErrorMessage();
        }
        ASSERT_EQ(fxScene_Update(scene_, dt), FX_OK);
    }
    /// Largest distance of the instance from a path, at the ends of the last two steps. @param from [s]
    /// earlier steps do not count
    double error(const Path& path, double from = 0.0) const
    {
        const Held held(scene_);
        FxSnapshotInfo info{};
        info.structSize = sizeof info;
        EXPECT_EQ(fxScene_GetSnapshotInfo(scene_, held.id, &info), FX_OK);
        double most = 0.0;
        for (const FxSnapshotStep step : {FX_SNAPSHOT_NEWER, FX_SNAPSHOT_OLDER}) {
            const bool isNewer = step == FX_SNAPSHOT_NEWER;
            const double end = double(isNewer ? info.tickNewer : info.tickOlder) / kSecond;
            if ((isNewer ? info.groupsNewer : info.groupsOlder) == 0 || end < from)
                continue;
            const FxSnapshotGroup group = held.group(step);
            most = std::max(
                most, distance({group.position[0], group.position[1], group.position[2]}, path.point(end)));
        }
        return most;
    }
    Point placed() const
    {
        const FxSnapshotGroup group = Held(scene_).group();
        return {group.position[0], group.position[1], group.position[2]};
    }
    /// World positions of all particles, in the order of their births.
    std::vector<Point> births() const
    {
        const Held held(scene_);
        const FxSnapshotGroup group = held.group();
        std::vector<Point> all(group.count);
        const char* const names[] = {"x", "y", "z"};
        for (size_t a = 0; a < 3; ++a) {
            FxSnapshotColumn column{};
            column.structSize = sizeof column;
            EXPECT_EQ(fxScene_FindSnapshotColumn(scene_, held.id, FX_SNAPSHOT_NEWER, 0, names[a], &column),
                      FX_OK);
            for (uint32_t i = 0; i < group.count; ++i)
                all[i][a] = double(column.values[i]);
        }
        for (Point& point : all) { // placements of the tests turn about y alone
            const double c = 1.0 - 2.0 * double(group.rotation[1]) * double(group.rotation[1]);
            const double s = 2.0 * double(group.rotation[1]) * double(group.rotation[3]);
            const double x = point[0], z = point[2];
            point = {group.position[0] + c * x + s * z, group.position[1] + point[1],
                     group.position[2] - s * x + c * z};
        }
        return all;
    }
    /// Largest distance between successive births over the smallest one, after the first tenth of a second.
    double unevenness() const
    {
        const std::vector<Point> all = births();
        double least = 1e9, most = 0.0;
        for (size_t i = 61; i < all.size(); ++i) {
            const double way = distance(all[i - 1], all[i]);
            least = std::min(least, way);
            most = std::max(most, way);
        }
        EXPECT_GT(all.size(), 200u);
        return most / least;
    }

    double seconds_ = 0.0;

private:
    struct Held
    {
        explicit Held(FxScene* of) : scene(of) { EXPECT_EQ(fxScene_AcquireSnapshot(scene, &id), FX_OK); }
        ~Held() { fxScene_ReleaseSnapshot(scene, id); }
        FxSnapshotGroup group(FxSnapshotStep step = FX_SNAPSHOT_NEWER) const
        {
            FxSnapshotGroup group{};
            group.structSize = sizeof group;
            EXPECT_EQ(fxScene_GetSnapshotGroup(scene, id, step, 0, &group), FX_OK);
            return group;
        }
        FxScene* scene;
        FxSnapshotId id{};
    };
};

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
    refuse([](FxMotion& m) { m.tick = 1; }); // before the last pose
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
