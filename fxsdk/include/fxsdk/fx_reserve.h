/// @file fx_reserve.h
/// Memory of instances that is allocated in advance. Include this to create effects during a game without any
/// allocation.
///
/// A reservation belongs to a scene, a preset and a quality. It holds the memory of a number of instances:
/// their solvers with the columns of all particles, room in every snapshot, and entries of all lists. An
/// instance of the preset takes one set and gives it back when it ends or is destroyed. Results, hashes and
/// saved states do not depend on reservations.
///
/// Threads: see each function. Ownership: a scene owns its reservations.
#ifndef FXSDK_FX_RESERVE_H
#define FXSDK_FX_RESERVE_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// State of a reservation. Fill structSize with sizeof before the call.
typedef struct FxReservationInfo
{
    uint32_t structSize; ///< set by the caller
    uint32_t count;      ///< number of instances that the reservation is for; 0: there is no reservation
    uint32_t available;  ///< number of sets that no instance uses
    uint32_t reserved;   ///< reserved; 0

    /// [byte] estimated memory of its solvers and snapshots: for each instance FxPresetInfo::memoryBytes,
    /// times the factor of the quality for numbers of particles where that is above 1.
    uint64_t bytes;

    /// Number of times since the reservation was made that an instance found no set, and allocated its
    /// memory.
    uint64_t misses;
} FxReservationInfo;

/// Allocates the memory of `count` instances of a preset, of which existing ones of the same quality count.
/// From then on, creating, updating and destroying up to this number of instances allocates nothing, neither
/// from FxAllocator nor from the C++ runtime, in a scene that is warm otherwise. That holds for instances
/// with default layer and mask that are not hidden, and whose parameters are not changed while they share a
/// simulation; see docs/howto/reserve-memory.md. Another call for the same preset and quality changes the
/// number; 0 frees what no instance uses. After fxRedirectPreset() the next fxScene_Update() of the scene
/// allocates the memory of its reservations anew, for the new content. Presets that have one content share
/// their sets: their numbers add up. After fxUnloadPreset() the next update ends the reservations.
/// fxScene_ReplacePreset() changes no reservation. [scene thread]
/// @param quality FxQuality of the instances, as FxInstanceDef::quality
/// @param count   0..65,536 and at most FxSceneDef::maxInstances
/// @return FX_OK, FX_ERROR_STALE_ID (preset), FX_ERROR_INVALID_ARGUMENT (out of range), FX_ERROR_CAPACITY
/// (all
///         reservations of the scene would exceed FxSceneDef::reserveLimit; the message has both numbers of
///         bytes), FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY. After a failure the
///         reservation is as before.
FX_API FxResult fxScene_ReservePreset(FxScene* scene, FxPresetId preset, uint32_t quality, uint32_t count);

/// Reads the state of a reservation: of the sum, if several presets have one content. [scene thread]
/// @param quality as fxScene_ReservePreset()
/// @param ioInfo  structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_STALE_ID (preset), FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize),
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetReservation(FxScene* scene, FxPresetId preset, uint32_t quality,
                                       FxReservationInfo* ioInfo);

#ifdef __cplusplus
}
#endif

#endif
