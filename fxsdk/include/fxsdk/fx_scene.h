/// @file fx_scene.h
/// A scene is a list of effect instances and a clock. Include this to place effects and advance time.
///
/// Threads: a scene belongs to the thread that created it [scene thread] until fxScene_AdoptThread() moves
/// it. Views may draw the scene on the GL thread while the scene thread updates it. Different scenes are
/// independent. Ownership: the caller owns every FxScene*; a scene owns its instances; ids never need
/// freeing.
///
/// Time: a scene advances in fixed steps. fxScene_Update() adds the frame's time and takes as many whole
/// steps as fit; what is left waits for the next call, and views interpolate. Hence any frame rate gives the
/// same particles. An instance costs nothing but its definition until the clock reaches its start, and again
/// after its end.
#ifndef FXSDK_FX_SCENE_H
#define FXSDK_FX_SCENE_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How much work an instance may cost: a gas has more particles, more neighbors and a finer sound at a higher
/// quality. Emitters are as their preset says at every quality. Chosen for the life of an instance, so that
/// the same calls give the same bits; what views draw is set in fx_view.h.
typedef enum FxQuality
{
    FX_QUALITY_DEFAULT = 0,          ///< of an instance: the scene's; of a scene: medium
    FX_QUALITY_LOW = 1,              ///< about a quarter of the particles
    FX_QUALITY_MEDIUM = 2,           ///< what presets are written for
    FX_QUALITY_HIGH = 3,             ///< about twice the particles
    FX_QUALITY_REFERENCE = 4,        ///< four times the particles and sound at full speed; not for games
    FX_QUALITY_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never valid
} FxQuality;

/// How a scene starts. Fill with fxDefaultSceneDef(), then change what you need.
typedef struct FxSceneDef
{
    uint32_t structSize;   ///< set by fxDefaultSceneDef(); do not touch
    uint32_t maxInstances; ///< most instances at a time, 1..2^24 - 1; default 65,536
    int64_t stepTicks;     ///< [tick] length of a step, 1/1000 s to 1 s; default 1/60 s
    int64_t maxFrameTicks; ///< [tick] longest time that one update simulates, at least stepTicks and at most
                           ///< 60 s; what exceeds it is dropped and counted; default 1/15 s
    float gravity[3];      ///< [m/s2] world, each within +-1000; default 0, -9.80665, 0
    uint32_t hasGround;    ///< 1 (default): presets with a ground have it in their plane y = 0, turned with
                           ///< them; 0: none
    uint32_t quality;      ///< FxQuality of instances that do not choose; default FX_QUALITY_DEFAULT
    uint32_t shareInstances; ///< 1 (default): instances that come out alike are simulated once, see
                             ///< fxScene_CreateInstance; 0: one by one. Results are the same.
    uint32_t disableCulling; ///< 1: every instance is stepped and shown always, for finding out what culling
                             ///< changes; default 0. See fx_activation.h
    uint32_t lockStep; ///< 1: no camera changes any state, ever: only instances that can be caught up bit
                       ///< for bit are out of sight, and absences of any length are replayed; default 0
    int64_t releaseAfterTicks; ///< [tick] 0..3600 s out of sight, after which memory is given back; default
                               ///< 5 s
    int64_t maxCatchUpTicks;   ///< [tick] 0..3600 s, longest absence that is replayed; what is longer is left
                               ///< out and counted; default 30 s
    uint32_t catchUpSteps;     ///< particle steps of one update that may be spent on replays, >= 1; default
                               ///< 200,000
    uint32_t reserved;         ///< 0
    /// Work units that one update may spend, 0 for no limit; default 10,000,000, about 100 ms of one core.
    /// See fxScene_Update. What it does not cover is done by the next updates, in the same steps with the
    /// same results.
    uint64_t workBudget;
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
                      10000000};
    return def;
}

/// What may be changed on a running instance. Fill with fxDefaultInstanceParameters().
typedef struct FxInstanceParameters
{
    uint32_t structSize; ///< set by fxDefaultInstanceParameters(); do not touch
    float intensity; ///< [1] 0..1000, multiplies birth rates and energies of what is still to come; default 1
    float wind[3];   ///< [m/s] world, each within +-1000, added to the preset's own; default 0
    uint32_t emitting; ///< 0: nothing new is born, what exists lives on; 1 (default): as the preset says
} FxInstanceParameters;

/// Parameters that leave the preset as its author made it.
static inline FxInstanceParameters fxDefaultInstanceParameters(void)
{
    FxInstanceParameters parameters = {sizeof(FxInstanceParameters), 1.0f, {0.0f, 0.0f, 0.0f}, 1};
    return parameters;
}

/// How an instance starts. Fill with fxDefaultInstanceDef(), then change what you need.
typedef struct FxInstanceDef
{
    uint32_t structSize; ///< set by fxDefaultInstanceDef(); do not touch
    float scale;         ///< [1] of all lengths, 1e-3..1e3; default 1
    FxPresetId preset;   ///< required
    double position[3];  ///< [m] world position of the effect's origin, each within +-1e9; default 0
    float rotation[4];   ///< unit quaternion x, y, z, w (length within 1e-3 of 1); default identity
    int64_t startTick;   ///< [tick] scene time of the start, >= 0; what is past means now; default 0
    uint64_t seed;       ///< same seed and same calls give the same bits on any number of threads; default 0
    float intensity;     ///< see FxInstanceParameters; default 1
    float wind[3];       ///< [m/s] see FxInstanceParameters; default 0
    uint32_t emitting;   ///< see FxInstanceParameters; default 1
    uint32_t destroyWhenFinished; ///< 1: the id turns stale when the effect has ended; default 0
    uint32_t quality;             ///< FxQuality, for life; default FX_QUALITY_DEFAULT: the scene's
    uint32_t reserved;            ///< must be 0
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
    return def;
}

/// Triangles that effects collide with: level geometry, at rest. Fill with fxDefaultCollisionMesh(), then set
/// positions and their number.
typedef struct FxCollisionMesh
{
    uint32_t structSize; ///< set by fxDefaultCollisionMesh(); do not touch
    float cellSize;      ///< [m] of the grid that stands for the mesh, 1e-3..1e3; details below it are lost.
                         ///< Default 0: the smallest with which four million cells suffice
    double origin[3];    ///< [m] world position that positions are relative to, each within +-1e9; default 0
    const float* positions;  ///< [m] x, y, z of each vertex, each within +-1e5; read during the call only
    const uint32_t* indices; ///< three a triangle, counter-clockwise seen from outside; read during the call
                             ///< only. Null (default): the vertices follow each other, three a triangle
    uint32_t vertexCount;    ///< 3..2^24
    uint32_t indexCount; ///< three times the triangles, of which there are at most 2^22; 0 without indices
} FxCollisionMesh;

/// A mesh without anything.
static inline FxCollisionMesh fxDefaultCollisionMesh(void)
{
    FxCollisionMesh mesh = FX_ZEROED;
    mesh.structSize = sizeof(FxCollisionMesh);
    return mesh;
}

/// Asks the host what stands in the way of one particle. Must not throw, block for long, or change what it
/// answers from.
///
/// Threads: called by several threads at once, those of the context's tasks and the scene thread, while
/// fxScene_Update() or fxScene_SeekInstance() runs. It may call nothing of this scene: that fails with
/// FX_ERROR_RE_ENTRANT on the scene thread and with FX_ERROR_WRONG_THREAD on others, and changes nothing.
/// Equal questions need equal answers through a whole call; for equal bits on every machine, always. What was
/// out of sight and is replayed asks now about ways of the past.
/// @param user      what FxContactHook says
/// @param from, to  [m] world, a straight way of at most one step
/// @param outShare  [1] 0..1, how much of the way is free
/// @param outNormal normal of what is met, world, of any length above 0, against the way
/// @return 0 when the way is free, then nothing else is read; otherwise 1
typedef int (*FxContactFunction)(void* user, const double from[3], const double to[3], float* outShare,
                                 float outNormal[3]);

/// Geometry that only the host knows, for presets with an obstacle of the shape "hook". Fill with
/// fxDefaultContactHook().
typedef struct FxContactHook
{
    uint32_t structSize;    ///< set by fxDefaultContactHook(); do not touch
    uint32_t reserved;      ///< 0
    FxContactFunction meet; ///< required
    void* user;             ///< handed to it; the host's own, default null
} FxContactHook;

/// A hook without a function.
static inline FxContactHook fxDefaultContactHook(void)
{
    FxContactHook hook = FX_ZEROED;
    hook.structSize = sizeof(FxContactHook);
    return hook;
}

/// Where an instance is in its life.
typedef enum FxInstanceState
{
    FX_INSTANCE_DORMANT = 0,  ///< waits for its start; has no particles and is never visited
    FX_INSTANCE_ACTIVE = 1,   ///< is stepped and shown
    FX_INSTANCE_FINISHED = 2, ///< has ended; has no particles and is never visited
    FX_INSTANCE_WAKING = 3,   ///< is in sight again and on its way to the present; not shown yet
    FX_INSTANCE_RESTING = 4,  ///< has neither particles nor anything to do for a while; is never visited
    FX_INSTANCE_HIDDEN = 5,   ///< is out of sight, see fx_activation.h; is never visited
    FX_INSTANCE_STATE_FORCE_32 =
        0x7fffffff ///< makes the type 32 bits wide with every compiler; never returned
} FxInstanceState;

/// Counters of a scene; counts are exact. Fill structSize with sizeof before the call.
typedef struct FxSceneStatistics
{
    uint32_t structSize;        ///< set by the caller
    uint32_t instances;         ///< existing, the sum of dormant, active, finished, waking,
                                ///< resting and hidden ones
    uint32_t instancesDormant;  ///< waiting for their start
    uint32_t instancesActive;   ///< being stepped and shown
    uint32_t instancesFinished; ///< ended and not yet destroyed
    uint32_t particles;         ///< alive after the last step
    uint64_t steps;             ///< steps taken since the scene was created
    uint64_t born;              ///< particles born since then
    uint64_t dropped;           ///< births refused because a preset's capacity was full
    uint64_t particleSteps;     ///< particles advanced, once per sub-step
    uint64_t neighborPairs;     ///< pairs of gas particles that interacted
    uint64_t clamped;           ///< values limited to keep the state finite
    uint64_t wakeFailures;      ///< instances that ended at their start because there was no memory
    uint64_t refusedUpdates;    ///< calls of fxScene_Update refused because dt was negative or not finite
    int64_t nowTick;            ///< [tick] scene time
    int64_t simulatedTick;      ///< [tick] end of the last step, <= nowTick
    int64_t
        droppedTicks; ///< [tick] time given up since the scene was created because it exceeded maxFrameTicks
    uint64_t updateAllocations; ///< allocations from the context's allocator during the last fxScene_Update
    int64_t debtTicks; ///< [tick] time that gases did not simulate because a step would have taken too many
                       ///< sub-steps; the sum over all gases
    uint64_t subSteps; ///< sub-steps of gases
    uint32_t simulations;      ///< existing; fewer than instances when some of those share one
    uint32_t reserved;         ///< 0
    uint32_t instancesWaking;  ///< in sight again, on their way to the present
    uint32_t instancesResting; ///< with nothing to do for a while
    uint32_t instancesHidden;  ///< out of sight
    uint32_t reserved2;        ///< 0
    uint64_t catchUpsSkipped;  ///< absences too long to be replayed: their time was left out
    int64_t timeDebtTicks;     ///< [tick] steps that are due and found too little work in updates so far; the
                               ///< next updates take them
    uint64_t updateWork;       ///< work units that the last update has spent, see FxSceneDef::workBudget
} FxSceneStatistics;

/// Creates an empty scene at time 0; the calling thread becomes its scene thread. [any]
/// @param outScene receives the scene; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxCreateScene(FxContext* context, const FxSceneDef* def, FxScene** outScene);

/// Destroys a scene with its instances. Null is allowed and does nothing. [scene thread]
/// @return FX_OK, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_INVALID_ARGUMENT (a view still shows
///         the scene or a snapshot of it is held: destroy or release that first). Nothing is destroyed on
///         failure.
FX_API FxResult fxDestroyScene(FxScene* scene);

/// Makes the calling thread the scene thread. No call on this scene may be in progress on another thread.
/// [any]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_AdoptThread(FxScene* scene);

/// Adds an instance; it wakes when the scene clock reaches def->startTick, or with the next step when that is
/// past. An instance that starts with the next step takes its memory here, a later one when it wakes.
/// Instances of one preset with the same start, seed, quality, intensity and emission, and with the same
/// gravity and wind once these are turned and scaled into their own space, share one simulation until one of
/// them is changed: they are stepped once, and shown each at its own place. Those with emitters of "space":
/// "world" also need the same placement. [scene thread]
/// @param outInstance receives the id; untouched on failure
/// @return FX_OK, FX_ERROR_STALE_ID (preset), FX_ERROR_INVALID_ARGUMENT (not finite or out of range),
///         FX_ERROR_VERSION (structSize), FX_ERROR_CAPACITY (maxInstances), FX_ERROR_OUT_OF_MEMORY,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT. A failure leaves the scene as it was.
FX_API FxResult fxScene_CreateInstance(FxScene* scene, const FxInstanceDef* def, FxInstanceId* outInstance);

/// Removes an instance with its particles; its id is stale at once, and the next step no longer shows it.
/// [scene thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_DestroyInstance(FxScene* scene, FxInstanceId instance);

/// Asks whether an id names an instance of this scene. [scene thread]
/// @return 1 when it does; 0 when it is stale or foreign, the scene is null, or the thread is wrong
FX_API uint32_t fxScene_IsValid(FxScene* scene, FxInstanceId instance);

/// Tells where an instance is in its life and how many particles it has. [scene thread]
/// @param outState     may be null; untouched on failure
/// @param outParticles may be null; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetInstanceState(FxScene* scene, FxInstanceId instance, FxInstanceState* outState,
                                         uint32_t* outParticles);

/// Moves an instance with all its particles; seen from the next step on. Particles of emitters with "space":
/// "world" stay where they are: there the move is taken as a straight one over the steps of the next
/// fxScene_Update() that takes any, and births lie evenly along it. [scene thread]
/// @param position [m] world, each within +-1e9
/// @param rotation unit quaternion x, y, z, w (length within 1e-3 of 1; it is normalized)
/// @param scale    [1] 1e-3..1e3
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT,
///         FX_ERROR_OUT_OF_MEMORY (an instance that turns out of the others' simulation needs its own)
FX_API FxResult fxScene_SetTransform(FxScene* scene, FxInstanceId instance, const double position[3],
                                     const float rotation[4], float scale);

/// Changes the parameters of an instance; they hold from the next step on. [scene thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null or out of range), FX_ERROR_VERSION (structSize),
/// FX_ERROR_STALE_ID,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY (as fxScene_SetTransform)
FX_API FxResult fxScene_SetParameters(FxScene* scene, FxInstanceId instance,
                                      const FxInstanceParameters* parameters);

/// Plays an instance at another speed from now on: its time is integer ticks, a 65536th of the scene's at a
/// time, so that equal calls give equal bits. A speed that is a whole number takes the same steps as speed 1,
/// several of them with each step of the scene; 0 lets the instance stand still. No speed is negative: to
/// play backwards, use speed 0 and fxScene_SeekInstance() before each frame. [scene thread]
/// @param speed [1] 0..16, rounded to a multiple of 1/65536. Nothing happens to an instance that has ended
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (not finite or out of range), FX_ERROR_STALE_ID,
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY (as fxScene_SetTransform)
FX_API FxResult fxScene_SetInstanceSpeed(FxScene* scene, FxInstanceId instance, float speed);

/// Takes an instance to a time of its own, forwards or backwards, as if it had been played to there from its
/// beginning under the wind, intensity and place that it has now: bit for bit, when the time is a whole
/// number of the scene's steps. Emitters whose motion has a closed form jump there; everything else takes
/// the steps again, in this call as far as FxSceneDef::workBudget goes, and for the rest the instance waits
/// (FX_INSTANCE_WAKING) through the next updates. What fxScene_TriggerEvent told it is left out. Views and
/// snapshots see it after the next fxScene_Update(), also after one of 0 s: an editor that stands still
/// seeks, updates by 0 and renders. Until time goes on, the whole scene is then shown as it is at its last
/// step. To play backwards, seek to an earlier time before each frame: where motion has no closed form, each
/// seek takes all steps from the beginning. [scene thread]
/// @param seconds [s] 0..86400 since its beginning, rounded to a tick
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (out of range, not started, ended), FX_ERROR_STALE_ID,
/// FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY. A failure leaves the scene as it was.
FX_API FxResult fxScene_SeekInstance(FxScene* scene, FxInstanceId instance, double seconds);

/// Tells an instance that something happened that its preset answers with births: a member of an emitter's
/// "events" with "on": "host" and this name. They happen at the beginning of the next step, at that emitter's
/// position; an instance that is out of sight hears of it when it is simulated again. Each call counts:
/// equal calls give equal bits. [scene thread]
/// @param name  what the preset calls it, at most 128 bytes
/// @param count [1] how often it happened, 0..65536; 0 does nothing. Nothing happens to an instance that has
///              ended
/// @return FX_OK, FX_ERROR_NOT_FOUND (the preset has no such event), FX_ERROR_INVALID_ARGUMENT (null, out of
///         range, or the instance has not started), FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxScene_TriggerEvent(FxScene* scene, FxInstanceId instance, const char* name, uint32_t count);

/// Sets the geometry that gases, fragments, and emitted particles that bounce collide with, in place of any
/// former one; it holds from the next step on. Closed surfaces are solid; behind others, of which the side
/// that is seen counter-clockwise is the front, two cells are. Walls thinner than a cell are thickened, so
/// that nothing slips through. The mesh is turned into a grid of distances here, on the threads of the
/// context, which takes seconds for a large one, 4 bytes a cell, at most 64 MiB, and 300 bytes a triangle
/// during the call; steps then cost a few samples a particle and allocate nothing. With geometry, instances
/// that collide share a simulation only when they stand at the same place. A saved state does not contain the
/// mesh, only what tells it from another. [scene thread]
/// @param mesh not kept; null: no geometry
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, not finite or out of range; an index beyond the vertices;
///         no triangle with an area), FX_ERROR_VERSION (structSize), FX_ERROR_CAPACITY (more than 2^24 cells:
///         the message says how many), FX_ERROR_OUT_OF_MEMORY, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT.
///         A failure leaves the scene as it was.
FX_API FxResult fxScene_SetCollisionMesh(FxScene* scene, const FxCollisionMesh* mesh);

/// Sets what particles ask about the host's own geometry, from the next step on; instances of presets that
/// have no obstacle of the shape "hook" do not. Saved states do not contain it: set it before restoring one.
/// [scene thread]
/// @param hook null: nothing is in the way any more. The function must be callable until another is set or
///             the scene is destroyed
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null or without a function), FX_ERROR_VERSION (structSize),
///         FX_ERROR_OUT_OF_MEMORY, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT. A failure leaves the scene as
///         it was.
FX_API FxResult fxScene_SetContactHook(FxScene* scene, const FxContactHook* hook);

/// Adds time and takes the steps that are due, then publishes the last two of them for views and hosts.
/// Allocates nothing once the scene is warm, except when an instance wakes. [scene thread]
///
/// An update spends at most FxSceneDef::workBudget, and what the piece of work that exceeds it still takes:
/// some thousand particles, or of one gas a sub-step of its own. Publishing is counted and divided as well.
/// Work is counted, not timed, so that equal calls stop at the same place on every machine. A step that is
/// not complete and published goes on with the next update; until then views see the last one that is, and
/// scene time is behind: FxSceneStatistics::timeDebtTicks. Debt beyond maxCatchUpTicks is dropped and counted
/// as droppedTicks. All steps give the bits that they give without a budget. Prewarm and seeks that the
/// budget does not cover make their instance wait (FX_INSTANCE_WAKING) while the others go on.
/// Until it is, transforms, parameters, speeds, triggers, seeks and new instances hold from the next step
/// on, and destroyed instances are shown in no later one. fxScene_SaveState, fxScene_GetSimulationHash,
/// fxScene_SetCollisionMesh and fxScene_SetContactHook complete it first, however long that takes;
/// fxScene_GetStateHash tells of what was published last.
/// @param dtSeconds [s] >= 0; 0 takes no step, and shows what fxScene_SeekInstance() has changed; more than
/// maxFrameTicks is shortened to it and counted
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (negative or not finite: counted, nothing advances),
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY (time has advanced, and what
///         the allocator refused is missing from the picture until it gives again), FX_ERROR_HOST_ANSWER
///         (time has advanced, but the contact hook gave answers that are none: a share that is not in 0..1,
///         a normal that is zero or not finite. The message says how many; they counted as free ways)
FX_API FxResult fxScene_Update(FxScene* scene, double dtSeconds);

/// Reads the counters of the scene. [scene thread]
/// @param ioStatistics structSize must be set; the rest is overwritten on success and untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
/// FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetStatistics(FxScene* scene, FxSceneStatistics* ioStatistics);

/// Hashes every particle of the last step and the time at which it ended, bit for bit: equal states at equal
/// times give equal hashes on any machine, any number of threads, and however the updates were cut, also when
/// no particle is left. What fxScene_SeekInstance() has changed since is heeded. Reads all particles: for
/// tests and replays, not for every frame. [scene thread] Particles of emitters whose preset asks for the GPU
/// ("compute") are cosmetic and left out, wherever they are computed.
/// @param outHash receives the hash; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT,
/// FX_ERROR_OUT_OF_MEMORY (after a seek)
FX_API FxResult fxScene_GetStateHash(FxScene* scene, uint64_t* outHash);

/// Hashes everything that decides what later steps give: instances with their parameters, and the whole state
/// of every simulation, seen or not. Scenes with equal hashes that get equal calls stay equal. It depends on
/// neither the frame rate, the number of threads nor on what is shared. For tests and replays. [scene thread]
/// @param outHash receives the hash; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT,
/// FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxScene_GetSimulationHash(FxScene* scene, uint64_t* outHash);

/// Writes the state of a scene: clock, counters, instances with their ids and parameters, simulations.
/// Presets, views and held snapshots are not in it. It can be restored by the same version of the library on
/// a machine with the same byte order. [scene thread]
/// @param buffer   receives the state; null asks for the size alone
/// @param capacity [byte] of buffer
/// @param outSize  [byte] of the state; it changes with every update; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_CAPACITY (the message says how many bytes it takes),
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxScene_SaveState(FxScene* scene, void* buffer, size_t capacity, size_t* outSize);

/// Brings a scene back to a saved state, from where it continues bit for bit. The scene must have the step,
/// gravity, ground and collision mesh of the one that was saved, and the presets of the saved instances must
/// be loaded in its context or be in use in the scene. All instances become those of the state: in the scene
/// that was saved, ids are valid again that were valid then; another scene finds its ids with
/// fxScene_GetInstances. Views show the restored step; held snapshots stay as they are. [scene thread]
/// @param state the bytes of fxScene_SaveState; not kept
/// @param size  [byte]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, or another step, gravity, ground or
///         collision mesh), FX_ERROR_PARSE (not a
///         state, cut or damaged), FX_ERROR_VERSION (saved by another version), FX_ERROR_NOT_FOUND (a
///         preset), FX_ERROR_CAPACITY (maxInstances), FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT,
///         FX_ERROR_OUT_OF_MEMORY. A failure leaves the scene as it was.
FX_API FxResult fxScene_RestoreState(FxScene* scene, const void* state, size_t size);

/// Lists the instances of a scene. [scene thread]
/// @param outInstances receives the ids, in an order that equal calls repeat; null asks for the number alone
/// @param capacity     ids that outInstances has room for
/// @param outCount     instances of the scene; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_CAPACITY (nothing is written), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetInstances(FxScene* scene, FxInstanceId* outInstances, uint32_t capacity,
                                     uint32_t* outCount);

#ifdef __cplusplus
}
#endif

#endif
