/// @file fx_motion.h
/// Instances on moving objects of the host. Include this to attach effects to vehicles, bones and
/// projectiles.
///
/// A host states where an object is at its own rate, a scene steps at fixed ticks. fxScene_SetMotion() gives
/// a pose with its time. At each step the instance stands where the motion between two poses is at the end of
/// that step, so that births lie on the path of the object at any frame rate. fxScene_SetTransform() in
/// contrast spreads a move over the steps of one update.
///
/// Threads: see each function. Ownership: poses are copied.
#ifndef FXSDK_FX_MOTION_H
#define FXSDK_FX_MOTION_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Number of poses of an instance that may lie in the future, and number of poses that are kept when they do
/// not. Older ones are discarded.
#define FX_MOTION_POSES 8

/// A pose of an object at a time. Fill with fxDefaultMotion(), then change members.
typedef struct FxMotion
{
    /// Set by fxDefaultMotion(); do not touch.
    uint32_t structSize;

    /// [1] factor for all lengths, 1e-3..1e3; default 1. Between two poses it changes linearly.
    float scale;

    /// [m] world, each component within +-1e9; default 0.
    double position[3];

    /// Unit quaternion x, y, z, w (length within 1e-3 of 1; it is normalized); default identity. Between two
    /// poses the object turns at a constant rate, the shorter way: less than half a turn between two poses.
    float rotation[4];

    /// [tick] scene time of the pose, before `aheadSeconds` is added; 0 (default): the scene time of the
    /// call, FxSceneStatistics::nowTick. At most 3600 s after the scene time.
    int64_t tick;

    /// [s] 0..3600, added to the time of the pose; default 0. A host that states poses before
    /// fxScene_Update(scene, dt) sets this member to dt.
    double aheadSeconds;

    /// [m/s] velocity of the object in world space, each component within +-1e6; default 0. Used only with
    /// hasVelocity.
    float linearVelocity[3];

    /// [rad/s] angular velocity of the object in world space, each component within +-1e6, with the sense of
    /// rotation of the host's quaternions; default 0. Only fxOffsetMotion() uses it.
    float angularVelocity[3];

    /// 1: between two poses with velocities, the path is the cubic with these positions and velocities at its
    /// ends (Hermite); 0 (default): the path is straight.
    uint32_t hasVelocity;

    /// Reserved; 0.
    uint32_t reserved;
} FxMotion;

/// The pose at the world's origin, at the time of the frame.
static inline FxMotion fxDefaultMotion(void)
{
    FxMotion motion = FX_ZEROED;
    motion.structSize = sizeof(FxMotion);
    motion.scale = 1.0f;
    motion.rotation[3] = 1.0f;
    return motion;
}

/// Adds a pose to the motion of an instance. At the end of each step the instance then stands at the place
/// that the motion has at that time, on the path between the pose before and the pose after. The first pose
/// is reached on a straight path from the placement of the instance at the last step. After the last pose the
/// instance stands there. A pose replaces all poses at its time and after it: after a long frame, of which
/// the scene adds only a part, the next pose takes the place of that at the end of the frame. Births of
/// emitters with "space": "world" lie on the path, with straight lines within a step. An instance
/// that starts within a step starts where the path is at the end of the step. fxScene_SetTransform() ends the
/// motion. Saved states and fxScene_GetSimulationHash() contain the poses. The first pose of an instance
/// allocates about 1 KiB, later ones allocate nothing. An instance that has ended does not change.
/// [scene thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, not finite, out of range), FX_ERROR_CAPACITY
///         (FX_MOTION_POSES poses after the scene time and before this pose), FX_ERROR_VERSION (structSize),
///         FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY. A failure
///         leaves the motion as it was.
FX_API FxResult fxScene_SetMotion(FxScene* scene, FxInstanceId instance, const FxMotion* motion);

/// Computes the pose of a point that is fixed to an object: of an effect that is attached to a bone.
/// Velocities are those of the point, v + w x r. Time and hasVelocity are copied. The result may be `parent`.
/// [any]
/// @param parent   pose of the object
/// @param offset   [m] position in the object's space, which its scale enlarges; each component within +-1e9
/// @param rotation unit quaternion relative to the object (length within 1e-3 of 1); null: identity
/// @param outMotion untouched on failure; its structSize must be set, for example by fxDefaultMotion()
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, not finite or out of range), FX_ERROR_VERSION (structSize)
FX_API FxResult fxOffsetMotion(const FxMotion* parent, const double offset[3], const float rotation[4],
                               FxMotion* outMotion);

#ifdef __cplusplus
}
#endif

#endif
