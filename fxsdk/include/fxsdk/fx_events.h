/// @file fx_events.h
/// Events tell the host what has happened in the updates of a scene, for example to play a sound or to place
/// a decal. fx_scene.h includes this header.
///
/// A scene records events if FxSceneDef::eventCapacity is above 0. The host reads them after
/// fxScene_Update(). Two sources give events:
///   Presets    A member of an emitter's "events" with "cue" names what happens to a particle: its birth, an
///              age, a collision, its death, or an event of the host. FxEvent::cue is the index of the name.
///   Instances  The end of an instance is an event.
/// Events that the emitter finds without a cue, because they cause births, are recorded if
/// FX_EVENTS_UNNAMED is set. Gases, fragments and volumes have no events of particles.
///
/// Order: by steps of the scene; within a step by time, then by the order in which the instances were
/// created, then by the order in which the emitter processes events. The events are the same for any number
/// of threads, any instruction set, any division of time into updates, any work budget, and with or without
/// shared simulations.
/// Hidden instances (fx_activation.h) are not simulated and have no events of particles. Their missed steps
/// give none later, as a sound would be late. FxSceneDef::disableCulling and presets with "offscreen":
/// "authoritative" have all events. A prewarm and a seek give no events of the time that they pass.
/// fxScene_RestoreState() discards the events that have not been read, and saved states contain none.
///
/// Threads: [scene thread] for all functions. Ownership: the caller owns the buffers.
#ifndef FXSDK_FX_EVENTS_H
#define FXSDK_FX_EVENTS_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Bits of FxSceneDef::eventKinds.
typedef enum FxEventKinds
{
    FX_EVENTS_FINISHED = 1,         ///< ends of instances
    FX_EVENTS_CUES = 2,             ///< events that a preset gives a cue
    FX_EVENTS_UNNAMED = 4,          ///< events without a cue that cause births
    FX_EVENTS_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never valid
} FxEventKinds;

/// What has happened.
typedef enum FxEventKind
{
    FX_EVENT_FINISHED = 0,         ///< the instance has ended; with destroyWhenFinished, its id is stale
    FX_EVENT_BORN = 1,             ///< a particle was born
    FX_EVENT_AGED = 2,             ///< a particle has reached the age that the preset states
    FX_EVENT_COLLIDED = 3,         ///< a contact of a particle with a surface has begun
    FX_EVENT_DIED = 4,             ///< a particle has died
    FX_EVENT_TRIGGERED = 5,        ///< fxScene_TriggerEvent() has triggered the event
    FX_EVENT_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never returned
} FxEventKind;

/// FxEvent::cue of an event without a cue.
#define FX_NO_CUE 0xFFFFFFFFu

/// One event. Vectors are in world space, for the placement of the instance at the end of the step.
typedef struct FxEvent
{
    /// In the first element of an array: set by the caller. Set by the library in all elements.
    uint32_t structSize;

    /// FxEventKind.
    uint32_t kind;

    /// Instance of the event; the instance may have been destroyed since.
    FxInstanceId instance;

    /// FxInstanceDef::userData of the instance, or the last number of fxScene_SetUserData().
    uint64_t userData;

    /// [tick] scene time of the event; for FX_EVENT_FINISHED the end of the step.
    int64_t tick;

    /// [s] scene time of the event.
    double seconds;

    /// [m] position of the particle or of the contact; for FX_EVENT_TRIGGERED that of the emitter; for
    /// FX_EVENT_FINISHED that of the instance.
    double position[3];

    /// [m/s] velocity of the particle, without the motion of the instance; for FX_EVENT_COLLIDED just after
    /// the contact, or just before if the particle dies.
    float velocity[3];

    /// [m/s] for FX_EVENT_COLLIDED: speed against the surface along its normal, just before the contact, >=
    /// 0; otherwise 0.
    float speed;

    /// For FX_EVENT_COLLIDED: unit normal of the surface, towards the particle; otherwise 0.
    float normal[3];

    /// Index of the cue among the cues of the preset, see fxGetPresetCue(); FX_NO_CUE: no cue.
    uint32_t cue;

    /// Index of the emitter in its preset, as FxSnapshotGroup::solver; 0 for FX_EVENT_FINISHED.
    uint32_t solver;

    /// Reserved; 0.
    uint32_t reserved;

    /// Id of the particle, as in FxSnapshotGroup::ids; for FX_EVENT_TRIGGERED the number of the trigger; 0
    /// for FX_EVENT_FINISHED.
    uint64_t particle;
} FxEvent;

/// Reads the oldest events and removes them from the scene. Events of a step appear when the step is
/// complete. If a step has more events than there is room for, its first ones are kept, and the others are
/// counted as lost. Events of a step for which memory is exhausted are counted as lost, too. A host that
/// reads after every update needs room for the events of one update. [scene thread]
/// @param ioEvents  receives the events, in order; structSize of the first element must be set, and is the
///                  distance of the elements in bytes. Null: only the number of events is read, and no event
///                  is removed
/// @param capacity  number of elements of `ioEvents`
/// @param outCount  receives the number of events written, at most `capacity`; without `ioEvents`, the number
///                  of events that can be read; untouched on failure
/// @param outLost   receives the number of events that were lost since the scene was created; may be null;
///                  untouched on failure
/// @return FX_OK (also if the scene records no events), FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION
///         (structSize), FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetEvents(FxScene* scene, FxEvent* ioEvents, uint32_t capacity, uint32_t* outCount,
                                  uint64_t* outLost);

/// Changes FxInstanceDef::userData of an instance. Events that are recorded from now on have this number;
/// simulation, culling and hashes do not depend on it. Saved states contain it. [scene thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_SetUserData(FxScene* scene, FxInstanceId instance, uint64_t userData);

/// Reads FxInstanceDef::userData of an instance, or the last number of fxScene_SetUserData(). [scene thread]
/// @param outUserData receives the number; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetUserData(FxScene* scene, FxInstanceId instance, uint64_t* outUserData);

#ifdef __cplusplus
}
#endif

#endif
