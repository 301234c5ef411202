/// @file fx_scene.h
/// A scene is a list of effect instances and a clock. Include this to place effects and advance time.
///
/// Threads: a scene belongs to the thread that created it [scene thread] until fxScene_AdoptThread() moves
/// it. Views may draw the scene on the GL thread while the scene thread updates it. Different scenes are
/// independent. Ownership: the caller owns every FxScene*; a scene owns its instances; ids never need
/// freeing.
///
/// Time: a scene advances in fixed steps. fxScene_Update() adds the frame's time and takes as many whole
/// steps as fit. The remainder is added to the next call. Views interpolate between steps. Hence any frame
/// rate gives the same particles. Before its start and after its end an instance costs only the memory of its
/// definition.
#ifndef FXSDK_FX_SCENE_H
#define FXSDK_FX_SCENE_H

#include "fxsdk/fx_base.h"
#include "fxsdk/fx_collision.h"
#include "fxsdk/fx_events.h"
#include "fxsdk/fx_parameters.h"
#include "fxsdk/fx_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Simulation quality of an instance. At a higher quality a gas has more particles, more neighbors and a less
/// reduced speed of sound. Emitters are the same at every quality. The quality of an instance never changes,
/// so that the same calls give the same bits. The quality of rendering is set in fx_view.h.
typedef enum FxQuality
{
    FX_QUALITY_DEFAULT = 0,   ///< for an instance: quality of its scene; for a scene: medium
    FX_QUALITY_LOW = 1,       ///< about a quarter of the particles
    FX_QUALITY_MEDIUM = 2,    ///< the quality that presets are designed for
    FX_QUALITY_HIGH = 3,      ///< about twice the particles
    FX_QUALITY_REFERENCE = 4, ///< four times the particles and the full speed of sound; not for real time
    FX_QUALITY_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never valid
} FxQuality;

/// Definition of a new scene. Fill with fxDefaultSceneDef(), then change members.
typedef struct FxSceneDef
{
    /// Set by fxDefaultSceneDef(); do not touch.
    uint32_t structSize;

    /// Maximum number of instances, 1..2^24 - 1; default 65,536.
    uint32_t maxInstances;

    /// [tick] length of a step, 1/1000 s to 1 s; default 1/60 s.
    int64_t stepTicks;

    /// [tick] longest time that one update simulates, at least stepTicks and at most 60 s; default 1/15 s.
    /// Longer times are shortened to maxFrameTicks, and the dropped time is counted.
    int64_t maxFrameTicks;

    /// [m/s2] world, each component within +-1000; default 0, -9.80665, 0. With units or axes of the host
    /// (FxContextDef), the exact default stands for standard gravity, downwards along the host's up axis.
    float gravity[3];

    /// 1 (default): the ground of a preset is the plane through the position of the instance, perpendicular
    /// to its local up axis. 0: no preset has a ground.
    uint32_t hasGround;

    /// FxQuality of instances without a quality of their own; default FX_QUALITY_DEFAULT.
    uint32_t quality;

    /// 1 (default): instances with equal results are simulated once, see fxScene_CreateInstance; 0: each
    /// instance is simulated by itself. Results are the same.
    uint32_t shareInstances;

    /// 1: every instance is always stepped and shown, to compare results with and without culling; default 0.
    /// See fx_activation.h.
    uint32_t disableCulling;

    /// 1: the state never depends on cameras. An instance is hidden only if its missing steps can be computed
    /// bit for bit. Absences of any length are replayed. Default 0.
    uint32_t lockStep;

    /// [tick] 0..3600 s, time out of sight after which an instance's memory is released; default 5 s.
    int64_t releaseAfterTicks;

    /// [tick] 0..3600 s, longest absence that is replayed; longer ones are skipped and counted; default 30 s.
    int64_t maxCatchUpTicks;

    /// Maximum number of particle steps that one update spends on replays, >= 1; default 200,000.
    uint32_t catchUpSteps;

    /// Reserved; 0.
    uint32_t reserved;

    /// Work units that one update may spend, 0 for no limit; default 10,000,000, about 100 ms of one core.
    /// The next updates do the remaining work, in the same steps and with the same results. See
    /// fxScene_Update.
    uint64_t workBudget;

    /// Maximum number of events that the host has not read, 0..1,000,000; default 0: no events are recorded.
    /// The memory, about 300 bytes each, is allocated when the scene is created. See fx_events.h.
    uint32_t eventCapacity;

    /// FxEventKinds, bits of the events that are recorded; default FX_EVENTS_FINISHED | FX_EVENTS_CUES.
    uint32_t eventKinds;

    /// [byte] upper limit of the memory of all reservations of the scene, see fx_reserve.h; default 1 GiB.
    uint64_t reserveLimit;
} FxSceneDef;

/// The definition of a scene that steps 60 times a second.
static inline FxSceneDef fxDefaultSceneDef(void)
{
    FxSceneDef def = {sizeof(FxSceneDef),
                      65536,
                      FX_TICKS_PER_SECOND / 60,
                      FX_TICKS_PER_SECOND / 15,
                      {0.0f, -9.80665f, 0.0f},
                      1,
                      FX_QUALITY_DEFAULT,
                      1,
                      0,
                      0,
                      5 * FX_TICKS_PER_SECOND,
                      30 * FX_TICKS_PER_SECOND,
                      200000,
                      0,
                      10000000,
                      0,
                      FX_EVENTS_FINISHED | FX_EVENTS_CUES,
                      UINT64_C(1) << 30};
    return def;
}

/// Range of FxInstanceDef::layer.
#define FX_LOWEST_LAYER (-16)
#define FX_HIGHEST_LAYER 15

/// Definition of a new instance. Fill with fxDefaultInstanceDef(), then set the preset and change members.
typedef struct FxInstanceDef
{
    /// Set by fxDefaultInstanceDef(); do not touch.
    uint32_t structSize;

    /// [1] factor for all lengths, 1e-3..1e3; default 1.
    float scale;

    /// Preset of the instance; required.
    FxPresetId preset;

    /// [m] world position of the effect's origin, each component within +-1e9; default 0.
    double position[3];

    /// Unit quaternion x, y, z, w (length within 1e-3 of 1); default identity.
    float rotation[4];

    /// [tick] scene time of the start, >= 0; if it is past, the start is with the next step; default 0.
    int64_t startTick;

    /// Seed of random numbers. The same seed and calls give the same bits on any number of threads; default
    /// 0.
    uint64_t seed;

    /// See FxInstanceParameters; default 1.
    float intensity;

    /// [m/s] see FxInstanceParameters; default 0.
    float wind[3];

    /// See FxInstanceParameters; default 1.
    uint32_t emitting;

    /// 1: the instance is destroyed when the effect has ended; default 0.
    uint32_t destroyWhenFinished;

    /// FxQuality, constant; default FX_QUALITY_DEFAULT: the quality of the scene.
    uint32_t quality;

    /// Reserved; must be 0.
    uint32_t reserved;

    /// See fxScene_SetVisibilityMask(); default 0xFFFFFFFF: the instance is seen by all frames whose mask is
    /// not 0.
    uint32_t visibilityMask;

    /// Reserved; must be 0.
    uint32_t reserved2;

    /// Any number of the host, returned by events and by fxScene_GetUserData(); default 0.
    uint64_t userData;

    /// [1] see FxInstanceParameters; default 1.
    float tint[3];

    /// FX_LOWEST_LAYER..FX_HIGHEST_LAYER, see fxScene_SetLayer(); default 0.
    int32_t layer;

    /// See fxScene_SetLayer(); default 0.
    int32_t sortKey;

    /// Reserved; must be 0.
    uint32_t reserved3;
} FxInstanceDef;

/// The definition of an instance that starts at once at the world's origin; only its preset is missing.
static inline FxInstanceDef fxDefaultInstanceDef(void)
{
    FxInstanceDef def = FX_ZEROED;
    def.structSize = sizeof(FxInstanceDef);
    def.scale = 1.0f;
    def.rotation[3] = 1.0f;
    def.intensity = 1.0f;
    def.emitting = 1;
    def.visibilityMask = 0xFFFFFFFFu;
    def.tint[0] = def.tint[1] = def.tint[2] = 1.0f;
    return def;
}

/// Lifecycle state of an instance.
typedef enum FxInstanceState
{
    FX_INSTANCE_DORMANT = 0,  ///< before its start; has no particles and costs no time
    FX_INSTANCE_ACTIVE = 1,   ///< is stepped and shown
    FX_INSTANCE_FINISHED = 2, ///< has ended; has no particles and costs no time
    FX_INSTANCE_WAKING = 3,   ///< in sight again and catching up; not shown yet
    FX_INSTANCE_RESTING = 4,  ///< has no particles, and no birth is due yet; costs no time
    FX_INSTANCE_HIDDEN = 5,   ///< out of sight, see fx_activation.h; costs no time
    FX_INSTANCE_STATE_FORCE_32 =
        0x7fffffff ///< makes the type 32 bits wide with every compiler; never returned
} FxInstanceState;

/// Counters of a scene; counts are exact. Fill structSize with sizeof before the call.
typedef struct FxSceneStatistics
{
    /// Set by the caller.
    uint32_t structSize;

    /// Number of existing instances: dormant, active, finished, waking, resting and hidden.
    uint32_t instances;

    /// Number of instances before their start.
    uint32_t instancesDormant;

    /// Number of instances that are stepped and shown.
    uint32_t instancesActive;

    /// Number of instances that have ended and are not yet destroyed.
    uint32_t instancesFinished;

    /// Number of particles alive after the last step.
    uint32_t particles;

    /// Number of steps since the scene was created.
    uint64_t steps;

    /// Number of particles born since the scene was created.
    uint64_t born;

    /// Number of births refused because a preset's capacity was full.
    uint64_t dropped;

    /// Number of particles advanced, summed over sub-steps.
    uint64_t particleSteps;

    /// Number of pairs of gas particles that interacted.
    uint64_t neighborPairs;

    /// Number of values limited to keep the state finite.
    uint64_t clamped;

    /// Number of instances that ended at their start because memory was exhausted.
    uint64_t wakeFailures;

    /// Number of calls of fxScene_Update refused because dtSeconds was negative or not finite.
    uint64_t refusedUpdates;

    /// [tick] scene time.
    int64_t nowTick;

    /// [tick] end of the last step, <= nowTick.
    int64_t simulatedTick;

    /// [tick] time dropped since the scene was created, because updates exceeded maxFrameTicks.
    int64_t droppedTicks;

    /// Number of allocations from the context's allocator during the last fxScene_Update.
    uint64_t updateAllocations;

    /// [tick] time that gases skipped because a step would have taken too many sub-steps; the sum over all
    /// gases.
    int64_t debtTicks;

    /// Number of sub-steps of gases.
    uint64_t subSteps;

    /// Number of existing simulations; smaller than `instances` when instances share simulations.
    uint32_t simulations;

    /// Reserved; 0.
    uint32_t reserved;

    /// Number of instances that are in sight again and catch up.
    uint32_t instancesWaking;

    /// Number of instances without particles in which no birth is due yet.
    uint32_t instancesResting;

    /// Number of instances that are out of sight.
    uint32_t instancesHidden;

    /// Reserved; 0.
    uint32_t reserved2;

    /// Number of absences that were too long to be replayed; their time was skipped.
    uint64_t catchUpsSkipped;

    /// [tick] steps that are due and did not fit into the work budget; the next updates take them.
    int64_t timeDebtTicks;

    /// Number of work units spent by the last update, see FxSceneDef::workBudget.
    uint64_t updateWork;

    /// Number of events that were lost since the scene was created, see fxScene_GetEvents().
    uint64_t eventsLost;

    /// Number of events that the host has not read.
    uint64_t eventsPending;
} FxSceneStatistics;

/// Creates an empty scene at time 0; the calling thread becomes its scene thread. [any]
/// @param outScene receives the scene; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxCreateScene(FxContext* context, const FxSceneDef* def, FxScene** outScene);

/// Destroys a scene with its instances. Null is allowed and does nothing. [scene thread]
/// @return FX_OK, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_INVALID_ARGUMENT (a view still shows
///         the scene or a snapshot of it is held: destroy the view or release the snapshot first). Nothing is
///         destroyed on failure.
FX_API FxResult fxDestroyScene(FxScene* scene);

/// Makes the calling thread the scene thread. No call on this scene may be in progress on another thread.
/// [any]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_AdoptThread(FxScene* scene);

/// Adds an instance. It starts when the scene clock reaches def->startTick, or with the next step when that
/// time is past. An instance that starts with the next step allocates its memory in this call. An instance
/// that starts later allocates its memory at its start. Instances of one preset share one simulation when
/// they have equal start, seed, quality, intensity, emission and tint, and equal gravity and wind in local
/// space. Emitters with "space": "world" also need equal placements. A shared simulation is stepped once and
/// shown at each instance's own placement. When an instance is changed, it gets a simulation of its own.
/// [scene thread]
/// @param outInstance receives the id; untouched on failure
/// @return FX_OK, FX_ERROR_STALE_ID (preset), FX_ERROR_INVALID_ARGUMENT (not finite or out of range),
///         FX_ERROR_VERSION (structSize), FX_ERROR_CAPACITY (maxInstances), FX_ERROR_OUT_OF_MEMORY,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT. A failure leaves the scene as it was.
FX_API FxResult fxScene_CreateInstance(FxScene* scene, const FxInstanceDef* def, FxInstanceId* outInstance);

/// Removes an instance with its particles. The id is stale at once. The next published step does not contain
/// the instance. [scene thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_DestroyInstance(FxScene* scene, FxInstanceId instance);

/// Removes all instances, as fxScene_DestroyInstance() removes one. The clock of the scene continues.
/// [scene thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_OUT_OF_MEMORY (no instance was removed),
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_DestroyAllInstances(FxScene* scene);

/// Tests whether an id names an instance of this scene. [scene thread]
/// @return 1 if the id names an instance of this scene; else 0, also for a null scene or the wrong thread
FX_API uint32_t fxScene_IsValid(FxScene* scene, FxInstanceId instance);

/// Reads the state of an instance and its number of particles. [scene thread]
/// @param outState     may be null; untouched on failure
/// @param outParticles may be null; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetInstanceState(FxScene* scene, FxInstanceId instance, FxInstanceState* outState,
                                         uint32_t* outParticles);

/// Moves an instance, visible from the next step on. Its particles move with the instance, except particles
/// of emitters with "space": "world". These emitters move on a straight line from the old to the new
/// placement, during the steps of the next fxScene_Update() that takes a step. Births are distributed evenly
/// along this line. [scene thread]
/// @param position [m] world, each component within +-1e9
/// @param rotation unit quaternion x, y, z, w (length within 1e-3 of 1; it is normalized)
/// @param scale    [1] 1e-3..1e3
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT,
///         FX_ERROR_OUT_OF_MEMORY (an instance that leaves a shared simulation needs a simulation of its own)
FX_API FxResult fxScene_SetTransform(FxScene* scene, FxInstanceId instance, const double position[3],
                                     const float rotation[4], float scale);

/// Changes the parameters of an instance from the next step on. [scene thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null or out of range), FX_ERROR_VERSION (structSize),
///         FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY (as
///         fxScene_SetTransform)
FX_API FxResult fxScene_SetParameters(FxScene* scene, FxInstanceId instance,
                                      const FxInstanceParameters* parameters);

/// Selects the frames that show an instance: those whose FxFrameDef::visibilityMask shares a bit with `mask`.
/// The frames that begin from now on follow it. In other frames the instance is not drawn, casts neither
/// light nor shadows, and does not shimmer. Simulation, culling, hashes and FxSnapshot do not depend on
/// masks; saved states contain them. A frame that leaves instances out copies the particles of the others
/// once a step. [scene thread]
/// @param mask any bits; 0: no frame shows the instance
/// @return FX_OK, FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY
///         (nothing has changed)
FX_API FxResult fxScene_SetVisibilityMask(FxScene* scene, FxInstanceId instance, uint32_t mask);

/// Sets the layer of an instance, and its order within the layer. Frames draw their layers in ascending
/// order, each as a whole over those before, whatever the depth of its instances: a far instance covers a
/// near one of a lower layer. Depth of the host hides instances of all layers. Within a layer all is as in a
/// frame that has only the instances of this layer: they are composed together, are lit by the lights of the
/// view and of their own layer, and cast shadows on their own layer. Where a composition draws particles one
/// by one, those of equal depth are drawn in the order of `sortKey`, then of creation: the greatest comes
/// last, on top. The frames that begin from now on follow it. Simulation, culling, hashes and FxSnapshot do
/// not depend on layers; saved states contain them. Each layer of a frame costs about as much as a view of
/// its own, and copies its particles once a step. See docs/howto/sort-layers.md. [scene thread]
/// @param layer   FX_LOWEST_LAYER..FX_HIGHEST_LAYER
/// @param sortKey any number
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null or out of range), FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY (nothing has changed)
FX_API FxResult fxScene_SetLayer(FxScene* scene, FxInstanceId instance, int32_t layer, int32_t sortKey);

/// Plays an instance at another speed from now on. Local time is counted in integer ticks, and the speed is
/// rounded to a multiple of 1/65536. Equal calls therefore give equal bits. At an integer speed n, the
/// instance takes the steps of speed 1, n of them for each step of the scene. At speed 0 the instance stands
/// still. Negative speeds are not allowed: to play backwards, use speed 0 and fxScene_SeekInstance() before
/// each frame. [scene thread]
/// @param speed [1] 0..16, rounded to a multiple of 1/65536. An instance that has ended does not change
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (not finite or out of range), FX_ERROR_STALE_ID,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY (as fxScene_SetTransform)
FX_API FxResult fxScene_SetInstanceSpeed(FxScene* scene, FxInstanceId instance, float speed);

/// Moves an instance to another local time, forwards or backwards. The result is that of playing the instance
/// from its beginning with its present wind, intensity and placement. The result is bit-identical when the
/// time is a whole number of scene steps. Emitters whose motion has a closed form jump to the time; all other
/// solvers repeat the steps. This call takes as many steps as FxSceneDef::workBudget allows. The next updates
/// take the remaining steps; until then the instance is FX_INSTANCE_WAKING. Events of fxScene_TriggerEvent()
/// are not replayed. Views and snapshots show the result after the next fxScene_Update(), even if that update
/// adds 0 s. An editor with a paused clock seeks, updates by 0 s and renders. Until time advances, the whole
/// scene is then shown at its last step. To play backwards, seek to an earlier time before each frame; where
/// motion has no closed form, each seek takes all steps from the beginning. [scene thread]
/// @param seconds [s] 0..86400 since its beginning, rounded to a tick
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (out of range, not started, ended), FX_ERROR_STALE_ID,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY. A failure leaves the scene as
///         it was.
FX_API FxResult fxScene_SeekInstance(FxScene* scene, FxInstanceId instance, double seconds);

/// Triggers the births that a preset defines for an event of the host: a member of an emitter's "events" with
/// "on": "host" and this name. The births happen at the beginning of the next step, at the position of that
/// emitter. In a hidden instance the births happen when the instance is simulated again. Equal calls give
/// equal bits. [scene thread]
/// @param name  name of the event in the preset, at most 128 bytes
/// @param count [1] number of events, 0..65536; 0 does nothing. An instance that has ended does not change
/// @return FX_OK, FX_ERROR_NOT_FOUND (the preset has no such event), FX_ERROR_INVALID_ARGUMENT (null, out of
///         range, or the instance has not started), FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxScene_TriggerEvent(FxScene* scene, FxInstanceId instance, const char* name, uint32_t count);

/// Adds time and takes the steps that are due, then publishes the last two steps for views and hosts.
/// Allocates nothing once the scene is warm, except when an instance starts or returns into sight. [scene
/// thread]
///
/// An update spends at most FxSceneDef::workBudget, exceeded by at most one piece of work: some thousand
/// particles, or one sub-step of a gas. Publishing a step also counts as work, and may be divided among
/// updates. Work is counted, not timed, so that equal calls stop at the same point on every machine. The next
/// update continues a step that is not complete and published. Until then views show the last published step,
/// and scene time lags by FxSceneStatistics::timeDebtTicks. Debt beyond maxCatchUpTicks is dropped and
/// counted as droppedTicks. All steps give the same bits as without a budget. An instance whose prewarm or
/// seek exceeds the budget is FX_INSTANCE_WAKING until the work is done. Other instances continue. While a
/// step is incomplete, transforms, parameters, speeds, triggers, seeks and new instances take effect with the
/// next step. Destroyed instances do not appear in later steps. Four functions complete the step first,
/// without a limit of time: fxScene_SaveState, fxScene_GetSimulationHash, fxScene_SetCollisionMesh and
/// fxScene_SetContactHook. fxScene_GetStateHash covers the last published step.
/// @param dtSeconds [s] >= 0; 0 takes no step and publishes the results of fxScene_SeekInstance(); a time
///             above maxFrameTicks is shortened to maxFrameTicks, and the dropped time is counted
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (negative or not finite: counted, nothing advances),
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY (time has advanced; instances
///         without memory are missing from the picture until an allocation succeeds), FX_ERROR_HOST_ANSWER
///         (time has advanced, but the contact callback returned invalid values: `outShare` outside of 0..1,
///         or a normal that is zero or not finite. The message states the number of invalid values. Paths
///         with invalid values count as paths without contact)
FX_API FxResult fxScene_Update(FxScene* scene, double dtSeconds);

/// Reads the counters of the scene. [scene thread]
/// @param ioStatistics structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetStatistics(FxScene* scene, FxSceneStatistics* ioStatistics);

/// Lists the instances of a scene. [scene thread]
/// @param outInstances receives the ids, in the same order after equal calls; null to get only the number
/// @param capacity     number of ids that fit into outInstances
/// @param outCount     number of instances of the scene; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_CAPACITY (nothing is written), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetInstances(FxScene* scene, FxInstanceId* outInstances, uint32_t capacity,
                                     uint32_t* outCount);

#ifdef __cplusplus
}
#endif

#endif
