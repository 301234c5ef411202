/// @file motion_fixture.h
/// Instances that follow motions in closed form, for the tests of fx_motion.h.
#pragma once

#include "tests/api/api_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace fx::test {

using Point = std::array<double, 3>;

constexpr double kTicksASecond = double(FX_TICKS_PER_SECOND);
constexpr double kTurns = 2.0;                            ///< [1/s] of the rotor
constexpr double kSpin = 2.0 * std::numbers::pi * kTurns; ///< [rad/s]
constexpr double kStepTurn = kSpin * kFrame;              ///< [rad] in a step

/// Particles that stay where they are born, 600 in a second.
inline std::string trailPreset(const char* space)
{
    return std::string(R"({"version": 1, "name": "trail", "ground": false, "emitters": [{"maxParticles": 4000,
        "space": ")") +
           space +
           R"(", "emission": {"rate": 600}, "lifetime": 100, "forces": {"gravity": 0}, "radius": 0.01}]})";
}

inline double distance(const Point& a, const Point& b)
{
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
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
    /// [m/s] of the straight line
    double speed() const { return distance(point(0.0), point(1.0)); }

    bool isRotor = false;
    bool hasVelocity = false;
};

class MotionTest : public ApiTest
{
protected:
    FxInstanceId follow(const Path& path, const char* space, int64_t startTick = 0)
    {
        return followWith(trailPreset(space), path, startTick);
    }
    FxInstanceId followWith(const std::string& preset, const Path& path, int64_t startTick = 0)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = loadText(context_, preset);
        def.startTick = startTick;
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
        motion.tick = int64_t(std::llround(seconds_ * kTicksASecond));
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
            const double end = double(isNewer ? info.tickNewer : info.tickOlder) / kTicksASecond;
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

} // namespace fx::test
