/// @file fx_preset.h
/// A preset is an effect as its author described it (*.fx.json), ready to be placed any number of times.
///
/// Threads: presets may be loaded and unloaded from any thread; loads of one context wait for each other.
/// Ownership: the context owns its presets. Instances share what a preset says: unloading it does not disturb
/// them.
#ifndef FXSDK_FX_PRESET_H
#define FXSDK_FX_PRESET_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What a loaded preset is. Fill structSize with sizeof before the call.
typedef struct FxPresetInfo
{
    uint32_t structSize;   ///< set by the caller
    uint32_t solverCount;  ///< emitters and gases
    int64_t durationTicks; ///< [tick] length of the effect's life; 0: until its last particle is gone
    uint64_t capacity;     ///< most particles alive at once in one instance
    char name[64];         ///< UTF-8, zero-terminated; longer names are cut
    // What an instance is expected to need at medium quality: estimates, for comparing presets.
    uint64_t memoryBytes; ///< [byte] when all that can live does, what is shown of it included
    uint64_t stepWork;    ///< work units of its most expensive step of 1/60 s, see FxSceneDef::workBudget
    uint64_t startWork;   ///< work units of its prewarm
} FxPresetInfo;

/// Loads a preset from a file of at most 4 MiB. Warnings go to the log. [any]
/// @param path      UTF-8; a relative one without ".." is asked of the context's asset hook before the file
/// system
/// @param outPreset receives the id; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_NOT_FOUND, FX_ERROR_IO, FX_ERROR_TOO_LARGE,
/// FX_ERROR_PARSE,
///         FX_ERROR_SCHEMA, FX_ERROR_VERSION (messages name file, line and JSON pointer), FX_ERROR_CAPACITY
///         (2^24 presets), FX_ERROR_RE_ENTRANT (called from the asset hook), FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxLoadPresetFile(FxContext* context, const char* path, FxPresetId* outPreset);

/// Loads a preset from a text in memory. [any]
/// @param text        UTF-8, need not be zero-terminated; not kept
/// @param length      [byte] of text, 1..4 MiB
/// @param displayName stands for the file's name in messages; may be null
/// @param outPreset   receives the id; untouched on failure
/// @return as fxLoadPresetFile
FX_API FxResult fxLoadPresetText(FxContext* context, const char* text, size_t length, const char* displayName,
                                 FxPresetId* outPreset);

/// Loads a preset of the library that is built in. [any]
/// @param name      such as "explosion" or "library:explosion"
/// @param outPreset receives the id; untouched on failure
/// @return as fxLoadPresetFile; FX_ERROR_NOT_FOUND when the library has no such preset
FX_API FxResult fxLoadPresetLibrary(FxContext* context, const char* name, FxPresetId* outPreset);

/// Forgets a preset; the id is stale afterwards, instances made from it live on. [any]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_RE_ENTRANT
FX_API FxResult fxUnloadPreset(FxContext* context, FxPresetId preset);

/// Tells what a preset is. [any]
/// @param ioInfo structSize must be set; the rest is overwritten on success and untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_VERSION (structSize),
/// FX_ERROR_RE_ENTRANT
FX_API FxResult fxGetPresetInfo(FxContext* context, FxPresetId preset, FxPresetInfo* ioInfo);

#ifdef __cplusplus
}
#endif

#endif
