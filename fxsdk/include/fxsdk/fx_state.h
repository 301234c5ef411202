/// @file fx_state.h
/// Hashes, saved states and restored states of a scene. fx_scene.h includes this header.
///
/// Threads: [scene thread] for all functions. Ownership: the caller owns the buffers.
#ifndef FXSDK_FX_STATE_H
#define FXSDK_FX_STATE_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Hashes the bits of every particle of the last step, and the time at which that step ended. Equal states at
/// equal times give equal hashes on any machine, with any number of threads and any division of time into
/// updates. Later changes by fxScene_SeekInstance() are included. The function reads all particles, so it is
/// meant for tests and replays, not for every frame. Particles of emitters whose member "compute" allows the
/// GPU are cosmetic and excluded, wherever they are computed. [scene thread]
/// @param outHash receives the hash; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT,
///         FX_ERROR_OUT_OF_MEMORY (after a seek)
FX_API FxResult fxScene_GetStateHash(FxScene* scene, uint64_t* outHash);

/// Hashes everything that later steps depend on: instances with their parameters, and the whole state of
/// every simulation, hidden ones included. Scenes with equal hashes and equal later calls stay equal. The
/// hash does not depend on the frame rate, the number of threads or the sharing of simulations. The function
/// is meant for tests and replays. [scene thread]
/// @param outHash receives the hash; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT,
///         FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxScene_GetSimulationHash(FxScene* scene, uint64_t* outHash);

/// Writes the state of a scene: clock, counters, instances with their ids and parameters, simulations. The
/// state does not contain presets, views and held snapshots. The same version of the library can restore the
/// state on a machine with the same byte order. [scene thread]
/// @param buffer   receives the state; null to get only the size
/// @param capacity [byte] of buffer
/// @param outSize  [byte] size of the state, which changes with every update; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_CAPACITY (the message states the required size),
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxScene_SaveState(FxScene* scene, void* buffer, size_t capacity, size_t* outSize);

/// Restores a saved state. The scene continues from this state bit for bit. The scene must have the step,
/// gravity, ground and collision mesh of the saved scene. The presets of the saved instances must be loaded
/// in the context or be in use in the scene. The instances of the state replace all instances. When the state
/// is restored into the scene that was saved, the instance ids of that time are valid again. After a
/// restoration into another scene, fxScene_GetInstances() returns the new ids. Views show the restored step;
/// held snapshots do not change. [scene thread]
/// @param state the bytes of fxScene_SaveState(); read during the call only
/// @param size  [byte]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, or another step, gravity, ground or collision mesh),
///         FX_ERROR_PARSE (not a state, cut or damaged), FX_ERROR_VERSION (saved by another version),
///         FX_ERROR_NOT_FOUND (a preset is missing), FX_ERROR_CAPACITY (maxInstances), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY. A failure leaves the scene as it was.
FX_API FxResult fxScene_RestoreState(FxScene* scene, const void* state, size_t size);

#ifdef __cplusplus
}
#endif

#endif
