/// @file fx_activation.h
/// Visibility culling of simulations: cameras, priorities and budgets of a scene. Include this to simulate
/// only the instances that a camera sees.
///
/// Without cameras (fxScene_SetFocus) every instance is in sight. With cameras, an instance whose bounds no
/// camera sees is hidden: it is not stepped, not shown, and costs nothing. When it comes into sight again,
/// it catches up as its preset's member "offscreen" specifies:
///   analytic       The present state is computed directly. The state is bit-identical to that of an effect
///                  that was never hidden.
///   replay         The missing steps are taken. FxSceneDef::catchUpSteps limits the work per update. The
///                  state is bit-identical to that of an effect that was never hidden. An absence longer
///                  than FxSceneDef::maxCatchUpTicks is not replayed; its time is skipped and counted.
///   coarse         While hidden, the effect takes one step for four steps of the scene. The state differs
///                  from that of an effect that was never hidden.
///   skip           The missing time is skipped. During the skipped time particles age or die, but do not
///                  move.
///   authoritative  The effect is never hidden.
/// If a preset has no member "offscreen", the value for gases is "authoritative". For other effects it is
/// "analytic" if all solvers can jump to any time, otherwise "replay". An effect of unknown extent is never
/// hidden because of its position; the preset's member "bound" states the extent.
///
/// Threads: [scene thread] for all functions. Ownership: the library copies all arguments.
#ifndef FXSDK_FX_ACTIVATION_H
#define FXSDK_FX_ACTIVATION_H

#include "fxsdk/fx_scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One camera. Fill with fxDefaultFocus(), then set the matrices as in FxFrameDef.
typedef struct FxFocus
{
    /// Set by fxDefaultFocus(); do not touch.
    uint32_t structSize;

    /// [pixel] height of the picture, 1..65536; default 1080.
    float height;

    /// [m] world position that the matrices are relative to, each component within +-1e9.
    double origin[3];

    /// Matrix from world coordinates minus `origin` to eye coordinates, column-major; rigid; default
    /// identity. See FxFrameDef::view.
    float view[16];

    /// Matrix from eye to clip coordinates, column-major, right-handed; perspective (elements 11 and 15 are
    /// -1 and 0) or orthographic (0 and 1); required.
    float projection[16];

    /// [m] largest distance from the eye at which instances are seen; 0 (default): no limit.
    double maxDistance;

    /// [m] 0..1e6, the frustum is widened by this distance on all sides; default 2. Effects near the frustum
    /// can cast light or shadow into it and therefore stay active. The margin also allows for fast rotations
    /// of the camera.
    float margin;

    /// [pixel] 0..65536, instances with a smaller radius on the picture are hidden; default 0.
    float minPixels;
} FxFocus;

/// A camera at the origin; the projection has to be set.
static inline FxFocus fxDefaultFocus(void)
{
    FxFocus focus = FX_ZEROED;
    int i;
    focus.structSize = sizeof(FxFocus);
    focus.height = 1080.0f;
    for (i = 0; i < 4; ++i)
        focus.view[5 * i] = 1.0f;
    focus.margin = 2.0f;
    return focus;
}

/// Hints of the host about one instance. Fill with fxDefaultActivationHints().
typedef struct FxActivationHints
{
    /// Set by fxDefaultActivationHints(); do not touch.
    uint32_t structSize;

    /// [1] 0..1e6, multiplies the size on the picture when a budget is exceeded; default 1.
    float priority;

    /// [m] 0..1e9, largest distance at which the instance is seen; 0 (default): no limit.
    float maxDistance;

    /// 1: the instance is occluded and is treated as out of sight; default 0.
    uint32_t occluded;
} FxActivationHints;

/// Default hints: priority 1, no distance limit, not occluded.
static inline FxActivationHints fxDefaultActivationHints(void)
{
    FxActivationHints hints = {sizeof(FxActivationHints), 1.0f, 0.0f, 0};
    return hints;
}

/// Limits for all instances in sight together. When a limit is exceeded, the instances with the smallest
/// product of size on the picture and priority are hidden. For active instances, the product is increased by
/// a quarter (hysteresis). Authoritative instances and the most significant instance are never hidden. Fill
/// with fxDefaultBudget().
typedef struct FxBudget
{
    /// Set by fxDefaultBudget(); do not touch.
    uint32_t structSize;

    /// Maximum number of living particles; 0 (default): no limit.
    uint32_t particles;

    /// [ms] 0..1e6, estimated time of a step; 0 (default): no limit.
    float milliseconds;

    /// [ns] 0..1e9, time per particle and step, for the estimate. 0 (default): the time is measured; then
    /// the set of hidden instances differs from run to run.
    float nanosecondsPerParticle;

    /// [byte] memory of particles, estimated from the presets' capacities; 0 (default): no limit.
    uint64_t bytes;
} FxBudget;

/// A budget without limits.
static inline FxBudget fxDefaultBudget(void)
{
    FxBudget budget = {sizeof(FxBudget), 0, 0.0f, 0.0f, 0};
    return budget;
}

/// Why an instance is not active.
typedef enum FxActivityReason
{
    FX_REASON_NONE = 0,          ///< it is active
    FX_REASON_NOT_STARTED = 1,   ///< its start time has not come
    FX_REASON_OUTSIDE = 2,       ///< outside of every frustum
    FX_REASON_TOO_FAR = 3,       ///< farther away than the maximum distance of the instance or of the camera
    FX_REASON_TOO_SMALL = 4,     ///< smaller than FxFocus::minPixels
    FX_REASON_OCCLUDED = 5,      ///< FxActivationHints::occluded is set
    FX_REASON_BUDGET = 6,        ///< a budget is exceeded and other instances are more significant
    FX_REASON_CATCHING_UP = 7,   ///< its past is being simulated
    FX_REASON_NOTHING_MOVES = 8, ///< it has no particles, and no birth is due yet
    FX_REASON_ENDED = 9,         ///< it has finished
    FX_REASON_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never returned
} FxActivityReason;

/// Values of FxInstanceActivity::policy.
enum
{
    FX_CATCH_UP_ANALYTIC = 0,     ///< jumps to the present
    FX_CATCH_UP_REPLAY = 1,       ///< takes the missing steps
    FX_CATCH_UP_COARSE = 2,       ///< is stepped coarsely
    FX_CATCH_UP_SKIP = 3,         ///< skips the missing time
    FX_CATCH_UP_AUTHORITATIVE = 4 ///< is never hidden
};

/// State and cost of an instance. Fill structSize with sizeof before the call.
typedef struct FxInstanceActivity
{
    uint32_t structSize; ///< set by the caller
    uint32_t state;      ///< FxInstanceState
    uint32_t reason;     ///< FxActivityReason
    uint32_t policy;     ///< FX_CATCH_UP_...
    uint32_t particles;  ///< number of particles of the instance
    float significance;  ///< [pixel] largest radius on the picture over all cameras, times the priority
    float milliseconds;  ///< [ms] estimated time of a step
    float reach;         ///< [m] largest distance of particles from the instance; infinite when unknown
    int64_t lagTicks;    ///< [tick] time that is not simulated yet
} FxInstanceActivity;

/// Counters of the last fxScene_Update(); all but estimatedMilliseconds are exact. Fill structSize with
/// sizeof before the call.
typedef struct FxFrameStats
{
    uint32_t structSize;   ///< set by the caller
    uint32_t instances;    ///< number of existing instances
    uint32_t dormant;      ///< number of instances before their start
    uint32_t active;       ///< number of instances that are stepped and shown
    uint32_t finished;     ///< number of instances that have ended and are not yet destroyed
    uint32_t waking;       ///< number of instances that catch up
    uint32_t resting;      ///< number of instances without particles in which no birth is due yet
    uint32_t hidden;       ///< number of instances that are out of sight, or in sight and beyond the budget
    uint32_t beyondBudget; ///< number of instances that are in sight, but hidden by the budget
    uint32_t wentOut;      ///< number of instances that became hidden
    uint32_t cameBack;     ///< number of instances that have reached the present again
    /// number of bounds tested against cameras; bounds belong to instances or to groups of hidden instances
    uint32_t judged;
    uint32_t simulations;          ///< number of existing simulations
    uint32_t particles;            ///< number of living particles of active instances
    uint64_t particleSteps;        ///< number of particles advanced, except while catching up
    uint64_t subSteps;             ///< number of sub-steps of gases
    uint64_t neighborPairs;        ///< number of pairs of gas particles that interacted
    uint64_t born;                 ///< number of particles born
    uint64_t dropped;              ///< number of births refused because a capacity was full
    uint64_t clamped;              ///< number of values limited to keep the state finite
    uint64_t catchUpParticleSteps; ///< number of particles advanced while catching up
    int64_t catchUpTicks;          ///< [tick] time caught up, the sum over instances
    int64_t debtTicks;             ///< [tick] simulated time that gases omitted to limit their work
    uint64_t allocations;          ///< number of allocations from the context's allocator
    double estimatedMilliseconds;  ///< [ms] estimated time of a step of all active instances
    /// [ns] time per particle and step, given or measured, on which the estimate is based
    double nanosecondsPerParticle;
} FxFrameStats;

/// Sets the cameras of a scene, from the next update on. Cameras only decide which instances are in sight.
/// [scene thread]
/// @param foci  `count` cameras one after the other; may be null when count is 0; then every instance is in
///         sight
/// @param count 0..64
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (the message names the member), FX_ERROR_VERSION (structSize),
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY. A failure changes nothing.
FX_API FxResult fxScene_SetFocus(FxScene* scene, const FxFocus* foci, uint32_t count);

/// Sets hints about an instance, from the next update on. [scene thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_STALE_ID,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_SetActivationHints(FxScene* scene, FxInstanceId instance,
                                           const FxActivationHints* hints);

/// Sets the budget of instances in sight, from the next update on. [scene thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_SetBudget(FxScene* scene, const FxBudget* budget);

/// Reads state, reason and cost of an instance. [scene thread]
/// @param ioActivity structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_STALE_ID,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetInstanceActivity(FxScene* scene, FxInstanceId instance,
                                            FxInstanceActivity* ioActivity);

/// Reads the counters of the last update. [scene thread]
/// @param ioStats structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetFrameStats(FxScene* scene, FxFrameStats* ioStats);

#ifdef __cplusplus
}
#endif

#endif
