// The functions of fx_motion.h.
#include "fxsdk/fx_motion.h"

#include "fxsdk/api/placement.h"
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"

namespace {

using fx::base::Status;

constexpr double kFarthestAhead = 3600.0; // [s]
constexpr float kFastest = 1e6f;          // [m/s] and [rad/s]

/// @param farthest, fastest in units of the host
void checkMotion(fx::api::Checks& check, const FxMotion& motion, double farthest, float fastest)
{
    fx::api::checkPlacement(check, farthest, motion.position, motion.rotation, motion.scale);
    check.range(motion.aheadSeconds, 0.0, kFarthestAhead, "motion.aheadSeconds");
    check.range3(motion.linearVelocity, -fastest, fastest, "motion.linearVelocity");
    check.range3(motion.angularVelocity, -kFastest, kFastest, "motion.angularVelocity");
    check.flag(motion.hasVelocity, "motion.hasVelocity");
    check.range(motion.reserved, 0u, 0u, "motion.reserved");
}

} // namespace

FxResult fxScene_SetMotion(FxScene* scene, FxInstanceId instance, const FxMotion* motion)
{
    return fx::api::withInstance("fxScene_SetMotion", scene, instance, [&](fx::scene::LocalId id) -> Status {
        FxMotion known;
        if (Status status = fx::api::readStruct(motion, "motion", fxDefaultMotion(), known); !status)
            return status;
        const fx::api::HostWorld& world = scene->context->world;
        fx::api::Checks check;
        checkMotion(check, known, world.fromMeters(fx::api::kFarthest), world.fromMeters(kFastest));
        const fx::base::Ticks now = scene->scene.clock().now();
        const fx::base::Ticks latest = now + fx::base::toTicks(kFarthestAhead);
        check.range(known.tick, fx::base::Ticks(0), latest, "motion.tick");
        if (!check.status())
            return check.status();
        fx::scene::MotionPose pose;
        pose.tick = (known.tick == 0 ? now : known.tick) + fx::base::toTicks(known.aheadSeconds);
        pose.placement = fx::api::toPlacement(world, known.position, known.rotation, known.scale);
        pose.velocity = world.vector(known.linearVelocity);
        pose.hasVelocity = known.hasVelocity != 0;
        if (pose.tick > latest)
            return fx::api::invalid("motion.tick plus motion.aheadSeconds is more than 3600 s ahead");
        return scene->scene.setMotion(id, pose);
    });
}

FxResult fxOffsetMotion(const FxMotion* parent, const double offset[3], const float rotation[4],
                        FxMotion* outMotion)
{
    return fx::api::guarded("fxOffsetMotion", nullptr, [&]() -> Status {
        FxMotion known;
        if (Status status = fx::api::readStruct(parent, "parent", fxDefaultMotion(), known); !status)
            return status;
        const float none[4] = {0.0f, 0.0f, 0.0f, 1.0f};
        const float* const turn = rotation ? rotation : none;
        fx::api::Checks check;
        check.notNull(offset, "offset");
        check.notNull(outMotion, "outMotion");
        if (!check.status())
            return check.status();
        // Of an unknown host's units: numbers that overflow nothing.
        checkMotion(check, known, 1e15, 1e12f);
        check.range3(offset, -1e15, 1e15, "offset");
        check.that(fx::api::isUnitQuaternion(turn),
                   "rotation is not a unit quaternion (x, y, z, w); 0, 0, 0, 1 turns nothing");
        if (!check.status())
            return check.status();
        // These formulas hold in every right-angled system of axes: of left-handed ones, quaternions and
        // angular velocities both turn the other way.
        const auto quaternion = [](const float* q) {
            return glm::normalize(glm::dquat(double(q[3]), double(q[0]), double(q[1]), double(q[2])));
        };
        const glm::dquat object = quaternion(known.rotation);
        const glm::dvec3 arm = object * (double(known.scale) * glm::dvec3(offset[0], offset[1], offset[2]));
        const glm::dquat turned = object * quaternion(turn);
        const glm::dvec3 spin(known.angularVelocity[0], known.angularVelocity[1], known.angularVelocity[2]);
        const glm::dvec3 swing = glm::cross(spin, arm);
        for (int a = 0; a < 3; ++a) {
            known.position[a] += arm[a];
            known.linearVelocity[a] = float(double(known.linearVelocity[a]) + swing[a]);
        }
        const double components[4] = {turned.x, turned.y, turned.z, turned.w};
        for (int i = 0; i < 4; ++i)
            known.rotation[i] = float(components[i]);
        return fx::api::writeStruct(known, outMotion, "outMotion");
    });
}
