/// @file fx_preset_load.h
/// Loads presets without stalling a frame: a worker thread of the host loads, any thread reads the progress.
/// Include this to load presets while a game runs.
///
/// Threads: the library starts no thread for a load. fxPresetLoad_Run() does all of the work, on the thread
/// that calls it; all other functions return at once and may be called from any thread meanwhile, except
/// fxDestroyPresetLoad(). Ownership: the caller owns every FxPresetLoad*; destroying a context destroys its
/// loads.
#ifndef FXSDK_FX_PRESET_LOAD_H
#define FXSDK_FX_PRESET_LOAD_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The load of one preset.
typedef struct FxPresetLoad FxPresetLoad;

/// State of a load.
typedef enum FxPresetLoadState
{
    FX_PRESET_LOAD_WAITING = 0,  ///< fxPresetLoad_Run() has not been called
    FX_PRESET_LOAD_RUNNING = 1,  ///< fxPresetLoad_Run() loads, or waits for another load of the context
    FX_PRESET_LOAD_READY = 2,    ///< the preset is loaded, fxPresetLoad_Finish() returns its id
    FX_PRESET_LOAD_FAILED = 3,   ///< fxPresetLoad_Finish() returns the error and its message
    FX_PRESET_LOAD_CANCELED = 4, ///< fxPresetLoad_Cancel() has ended the load
    FX_PRESET_LOAD_STATE_FORCE_32 =
        0x7fffffff ///< makes the type 32 bits wide with every compiler; never returned
} FxPresetLoadState;

/// Progress of a load. Fill structSize with sizeof before the call.
typedef struct FxPresetLoadProgress
{
    /// Set by the caller.
    uint32_t structSize;

    /// FxPresetLoadState.
    uint32_t state;

    /// [1] 0..1, never decreases; 1 exactly when the preset is loaded. Parts count by their number, not by
    /// their time.
    float fraction;

    /// Number of files that were read, the preset included.
    uint32_t filesRead;

    /// Name of what is being loaded: a file, or an element of the preset such as "emitters 2 of 5". UTF-8,
    /// zero-terminated; longer names are cut.
    char item[96];
} FxPresetLoadProgress;

/// Describes a load; reads nothing yet. [any]
/// @param path    UTF-8, a path as of fxLoadPresetFile(), or "library:NAME"; copied
/// @param text    null: the file is read. Otherwise the text of the preset, copied, and loaded as by
///                fxLoadPresetTextAt() with this path
/// @param length  [byte] length of the text, 1 byte to 4 MiB; 0 without a text
/// @param outLoad receives the load; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_TOO_LARGE (length), FX_ERROR_OUT_OF_MEMORY,
///         FX_ERROR_RE_ENTRANT (in a callback of a call that changes the context)
FX_API FxResult fxBeginPresetLoad(FxContext* context, const char* path, const char* text, size_t length,
                                  FxPresetLoad** outLoad);

/// Loads the preset with its images, meshes and volumes. The result is that of fxLoadPresetFile(), bit for
/// bit. Loads of one context follow each other, so that one worker thread for all is enough; functions that
/// load at once, such as fxLoadPresetFile(), wait meanwhile. The asset hook, the allocator and the log are
/// called on this thread. When the load has ended, the function does nothing and returns the same result.
/// [any]
/// @return FX_OK, FX_ERROR_INTERRUPTED (canceled), FX_ERROR_RE_ENTRANT (another thread runs this load, or the
///         call is in a callback of another load; the state is as before, and the load can run later), and
///         the codes of fxLoadPresetFile(). A load that fails or is canceled leaves nothing in the context.
FX_API FxResult fxPresetLoad_Run(FxPresetLoad* load);

/// Reads how far a load is. [any]
/// @param ioProgress structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize)
FX_API FxResult fxPresetLoad_GetProgress(FxPresetLoad* load, FxPresetLoadProgress* ioProgress);

/// Ends a load before its next file or its next element of the preset; a load that waits for another one ends
/// after that one. Has no effect on a load that has ended. [any, also from the asset hook]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT
FX_API FxResult fxPresetLoad_Cancel(FxPresetLoad* load);

/// Returns the result of a load that has ended. May be called again, with the same result. The preset is then
/// owned by the context, as after fxLoadPresetFile(). Compute programs of its emitters are compiled by
/// fxContext_WarmUp() or by the first frame that needs them, on the GL thread. [any]
/// @param outPreset receives the id; untouched on failure
/// @return FX_OK, FX_ERROR_INTERRUPTED (canceled), FX_ERROR_INVALID_ARGUMENT (null, or the load has not
///         ended), and the code and message of the failed load: messages name file, line and JSON pointer
FX_API FxResult fxPresetLoad_Finish(FxPresetLoad* load, FxPresetId* outPreset);

/// Destroys a load. A preset that is ready and whose id was never returned is unloaded, as by
/// fxUnloadPreset(). Null is allowed and does nothing. [any; no other call on this load may be in progress or
/// begin later, such as fxPresetLoad_Run() in a job that still waits for a thread]
/// @return FX_OK, FX_ERROR_RE_ENTRANT (fxPresetLoad_Run() is in progress: cancel it and wait until it has
///         returned; or the call is in a callback of a call that changes the context; nothing was destroyed)
FX_API FxResult fxDestroyPresetLoad(FxPresetLoad* load);

#ifdef __cplusplus
}
#endif

#endif
