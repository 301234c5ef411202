/// @file fx_activation.h
/// Which instances cost anything: where somebody looks, what matters more, and how much all may take. Include
/// this to let a scene simulate only what is called for.
///
/// Without cameras (fxScene_SetFocus) everything is in sight. With them, an instance whose bounds no camera
/// sees is hidden: it is neither stepped nor shown nor visited. When it comes into sight it is brought to the
/// present as its preset's member "offscreen" says:
///   analytic       jumps there: the same bits as if it had never been hidden
///   replay         takes the missing steps, so many an update (FxSceneDef::catchUpSteps): the same bits; an
///                  absence longer than FxSceneDef::maxCatchUpTicks is left out instead, and counted
///   coarse         is stepped while hidden, four steps of the scene in one: other bits
///   skip           the missing time is left out: particles age, or are gone, but have not moved
///   authoritative  is never hidden
/// Without the member, gases are authoritative, and other effects are analytic if all they have can jump, and
/// replayed otherwise. An effect whose extent nobody knows is never hidden for its place; the preset's member
/// "bound" tells it.
/// Threads: [scene thread] throughout. Ownership: nothing given here is kept.
#ifndef FXSDK_FX_ACTIVATION_H
#define FXSDK_FX_ACTIVATION_H

#include "fxsdk/fx_scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One camera. Fill with fxDefaultFocus(), then set it as in FxFrameDef.
typedef struct FxFocus
{
    uint32_t structSize;  ///< set by fxDefaultFocus(); do not touch
    float height;         ///< [pixel] of the picture, 1..65536; default 1080
    double origin[3];     ///< [m] world position that the matrices are relative to, each within +-1e9
    float view[16];       ///< world minus origin to eye, column-major; rigid; default identity
    float projection[16]; ///< eye to clip, column-major, right-handed; perspective (elements 11 and 15 are -1
                          ///< and 0) or orthographic (0 and 1); required
    double maxDistance;   ///< [m] from the eye, beyond which nothing is seen; 0 (default): no limit
    float margin;         ///< [m] 0..1e6, by which the frustum is widened on all sides, for what throws light
                          ///< or shadow into it, and for cameras that turn quickly; default 2
    float minPixels;      ///< [pixel] 0..65536, radius on the picture below which nothing is seen; default 0
} FxFocus;

/// A camera in the origin whose projection is missing.
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

/// What the host knows about an instance. Fill with fxDefaultActivationHints().
typedef struct FxActivationHints
{
    uint32_t structSize; ///< set by fxDefaultActivationHints(); do not touch
    float priority;    ///< [1] 0..1e6, multiplies the size on the picture where budgets are short; default 1
    float maxDistance; ///< [m] 0..1e9, beyond which nobody sees it; 0 (default): no limit
    uint32_t occluded; ///< 1: something stands before it, treat it as out of sight; default 0
} FxActivationHints;

/// Hints of an instance about which nothing is known.
static inline FxActivationHints fxDefaultActivationHints(void)
{
    FxActivationHints hints = {sizeof(FxActivationHints), 1.0f, 0.0f, 0};
    return hints;
}

/// What all instances in sight together may take; those with the smallest size times priority are hidden when
/// it is not enough. Those that run count a quarter more, so that nobody takes turns. Never hidden are
/// authoritative ones and the most significant one. Fill with fxDefaultBudget().
typedef struct FxBudget
{
    uint32_t structSize;          ///< set by fxDefaultBudget(); do not touch
    uint32_t particles;           ///< alive at once; 0 (default): no limit
    float milliseconds;           ///< [ms] 0..1e6 of a step, as estimated; 0 (default): no limit
    float nanosecondsPerParticle; ///< [ns] 0..1e9 of a step, for the estimate; 0 (default): measured, so that
                                  ///< who is hidden differs from run to run
    uint64_t bytes;               ///< [byte] of particles, as estimated from the presets' capacities; 0
                                  ///< (default): no limit
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
    FX_REASON_NONE = 0,             ///< it is active
    FX_REASON_NOT_STARTED = 1,      ///< it waits for its start
    FX_REASON_OUTSIDE = 2,          ///< no camera looks there
    FX_REASON_TOO_FAR = 3,          ///< beyond its own distance or the camera's
    FX_REASON_TOO_SMALL = 4,        ///< fewer pixels than the camera asks for
    FX_REASON_OCCLUDED = 5,         ///< the host says so
    FX_REASON_BUDGET = 6,           ///< others matter more
    FX_REASON_CATCHING_UP = 7,      ///< its past is being simulated
    FX_REASON_NOTHING_MOVES = 8,    ///< it has nothing to do for a while
    FX_REASON_ENDED = 9,            ///< it has finished
    FX_REASON_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never returned
} FxActivityReason;

/// Values of FxInstanceActivity::policy.
enum
{
    FX_CATCH_UP_ANALYTIC = 0,     ///< jumps to the present
    FX_CATCH_UP_REPLAY = 1,       ///< takes the missing steps
    FX_CATCH_UP_COARSE = 2,       ///< is stepped coarsely
    FX_CATCH_UP_SKIP = 3,         ///< leaves the time out
    FX_CATCH_UP_AUTHORITATIVE = 4 ///< is never hidden
};

/// What an instance costs and why. Fill structSize with sizeof before the call.
typedef struct FxInstanceActivity
{
    uint32_t structSize; ///< set by the caller
    uint32_t state;      ///< FxInstanceState
    uint32_t reason;     ///< FxActivityReason
    uint32_t policy;     ///< FX_CATCH_UP_...
    uint32_t particles;  ///< that its solvers hold
    float significance;  ///< [pixel] on the picture of the best camera, times priority
    float milliseconds;  ///< [ms] of a step, estimated
    float reach;         ///< [m] from its position, within which it stays; infinite when unknown
    int64_t lagTicks;    ///< [tick] not simulated yet
} FxInstanceActivity;

/// Counters of the last fxScene_Update(); exact but for the estimate. Fill structSize with sizeof before the
/// call.
typedef struct FxFrameStats
{
    uint32_t structSize;    ///< set by the caller
    uint32_t instances;     ///< existing
    uint32_t dormant;       ///< waiting for their start
    uint32_t active;        ///< stepped and shown
    uint32_t finished;      ///< ended and not yet destroyed
    uint32_t waking;        ///< catching up
    uint32_t resting;       ///< nothing to do for a while
    uint32_t hidden;        ///< out of sight, those beyond the budget among them
    uint32_t beyondBudget;  ///< in sight, but others matter more
    uint32_t wentOut;       ///< became hidden
    uint32_t cameBack;      ///< reached the present again
    uint32_t judged;        ///< places, of instances or of groups of hidden ones, compared with cameras
    uint32_t simulations;   ///< existing
    uint32_t particles;     ///< alive in active instances
    uint64_t particleSteps; ///< particles advanced, catching up apart
    uint64_t subSteps;      ///< of gases
    uint64_t neighborPairs; ///< of gas particles
    uint64_t born;          ///< particles
    uint64_t dropped;       ///< births refused
    uint64_t clamped;       ///< values limited
    uint64_t catchUpParticleSteps; ///< particles advanced while catching up
    int64_t catchUpTicks;          ///< [tick] caught up, the sum over instances
    int64_t debtTicks;             ///< [tick] that gases did not simulate
    uint64_t allocations;          ///< from the context's allocator
    double estimatedMilliseconds;  ///< [ms] of a step of all active instances
    double nanosecondsPerParticle; ///< [ns] of a step, given or measured: what the estimate stands on
} FxFrameStats;

/// Says where somebody looks, from the next update on; nothing else depends on the cameras. [scene thread]
/// @param foci  `count` cameras one after the other; may be null when count is 0: everything is in sight
/// @param count 0..64
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (the message names the member), FX_ERROR_VERSION (structSize),
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY. A failure changes nothing.
FX_API FxResult fxScene_SetFocus(FxScene* scene, const FxFocus* foci, uint32_t count);

/// Says what the host knows about an instance, from the next update on. [scene thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_STALE_ID,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_SetActivationHints(FxScene* scene, FxInstanceId instance,
                                           const FxActivationHints* hints);

/// Limits what instances in sight may take, from the next update on. [scene thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_SetBudget(FxScene* scene, const FxBudget* budget);

/// Tells what an instance costs and why. [scene thread]
/// @param ioActivity structSize must be set; the rest is overwritten on success and untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_STALE_ID,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetInstanceActivity(FxScene* scene, FxInstanceId instance,
                                            FxInstanceActivity* ioActivity);

/// Reads the counters of the last update. [scene thread]
/// @param ioStats structSize must be set; the rest is overwritten on success and untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetFrameStats(FxScene* scene, FxFrameStats* ioStats);

#ifdef __cplusplus
}
#endif

#endif
