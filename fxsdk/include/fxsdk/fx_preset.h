/// @file fx_preset.h
/// A preset is the description of an effect (*.fx.json). It can be instantiated any number of times.
///
/// Threads: presets may be loaded and unloaded from any thread; loads of one context are serialized.
/// Ownership: the context owns its presets. Instances keep the data of their preset when the preset is
/// unloaded.
#ifndef FXSDK_FX_PRESET_H
#define FXSDK_FX_PRESET_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Properties of a loaded preset. Fill structSize with sizeof before the call.
typedef struct FxPresetInfo
{
    /// Set by the caller.
    uint32_t structSize;

    /// Number of emitters and gases.
    uint32_t solverCount;

    /// [tick] lifetime of the effect; 0: the effect ends when its last particle has died.
    int64_t durationTicks;

    /// Maximum number of living particles of one instance.
    uint64_t capacity;

    /// Name of the preset, UTF-8, zero-terminated; longer names are cut.
    char name[64];

    // The members below are estimates for one instance at medium quality.
    /// [byte] memory at full capacity, snapshots included.
    uint64_t memoryBytes;

    /// Number of work units of the most expensive step of 1/60 s, see FxSceneDef::workBudget.
    uint64_t stepWork;

    /// Number of work units of the prewarm, see FxSceneDef::workBudget.
    uint64_t startWork;

    /// Number of cues, the names that the preset gives to events for the host; see fxGetPresetCue().
    uint32_t cueCount;

    /// Reserved; 0.
    uint32_t reserved;
} FxPresetInfo;

/// A cue of a preset. Fill structSize with sizeof before the call.
typedef struct FxPresetCue
{
    /// Set by the caller.
    uint32_t structSize;

    /// Index of the cue, as in FxEvent::cue.
    uint32_t cue;

    /// Name, UTF-8, zero-terminated.
    char name[64];
} FxPresetCue;

/// How the author of a preset shows it: the member "preview" of the preset, or open country late in the
/// afternoon. With these members a view looks as in the documentation. Fill structSize with sizeof before the
/// call.
typedef struct FxPresetPreview
{
    /// Set by the caller.
    uint32_t structSize;

    /// [EV100] exposure, for FxViewSettings::exposureEv100.
    float exposureEv100;

    /// Unit vector towards the sun, for FxViewSettings::sunDirection.
    float sunDirection[3];

    /// [lx] for FxViewSettings::sunIlluminance.
    float sunIlluminance[3];

    /// [cd/m2] for FxViewSettings::skyLuminance.
    float skyLuminance[3];

    /// [1] for FxViewSettings::groundAlbedo.
    float groundAlbedo;

    /// [s] age of the effect at which a still is taken.
    double time;

    /// 1: the camera is given; 0: it is not, see fxScene_SetFrameCamera().
    uint32_t hasCamera;

    /// [radian] vertical field of view.
    float fovY;

    /// [m] position of the camera, with the effect at the origin.
    double cameraPosition[3];

    /// [m] place at which the camera looks.
    double cameraTarget[3];
} FxPresetPreview;

/// Loads a preset from a file of at most 4 MiB. Warnings go to the log. [any]
/// @param path      UTF-8; a relative path without ".." is passed to the context's asset hook before the
///                  file system is searched; "library:NAME" is a preset of the built-in library
/// @param outPreset receives the id; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_NOT_FOUND, FX_ERROR_IO, FX_ERROR_TOO_LARGE,
///         FX_ERROR_PARSE, FX_ERROR_SCHEMA, FX_ERROR_VERSION (messages name file, line and JSON pointer),
///         FX_ERROR_CAPACITY (2^24 presets), FX_ERROR_RE_ENTRANT (called from the asset hook),
///         FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxLoadPresetFile(FxContext* context, const char* path, FxPresetId* outPreset);

/// Loads a preset from a text in memory. [any]
/// @param text        UTF-8, need not be zero-terminated; read during the call only
/// @param length      [byte] length of the text, 1 byte to 4 MiB
/// @param displayName used as the file's name in messages; may be null
/// @param outPreset   receives the id; untouched on failure
/// @return the codes of fxLoadPresetFile()
FX_API FxResult fxLoadPresetText(FxContext* context, const char* text, size_t length, const char* displayName,
                                 FxPresetId* outPreset);

/// Loads a preset of the built-in library. [any]
/// @param name      such as "explosion" or "library:explosion"
/// @param outPreset receives the id; untouched on failure
/// @return the codes of fxLoadPresetFile(); FX_ERROR_NOT_FOUND when the library has no such preset
FX_API FxResult fxLoadPresetLibrary(FxContext* context, const char* name, FxPresetId* outPreset);

/// Unloads a preset. Its id is stale afterwards; existing instances continue. [any]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_RE_ENTRANT
FX_API FxResult fxUnloadPreset(FxContext* context, FxPresetId preset);

/// Reads properties of a preset. [any]
/// @param ioInfo structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_VERSION (structSize),
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxGetPresetInfo(FxContext* context, FxPresetId preset, FxPresetInfo* ioInfo);

/// Reads how the author of a preset shows it. [any]
/// @param ioPreview structSize must be set; other members are overwritten on success, untouched on failure
/// @return the codes of fxGetPresetInfo()
FX_API FxResult fxGetPresetPreview(FxContext* context, FxPresetId preset, FxPresetPreview* ioPreview);

/// Reads a cue of a preset. [any]
/// @param cue   0..FxPresetInfo::cueCount - 1
/// @param ioCue structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, or no such cue), FX_ERROR_STALE_ID, FX_ERROR_VERSION
///         (structSize), FX_ERROR_RE_ENTRANT
FX_API FxResult fxGetPresetCue(FxContext* context, FxPresetId preset, uint32_t cue, FxPresetCue* ioCue);

/// Finds a cue of a preset by its name. [any]
/// @param name   name of the cue in the preset
/// @param outCue receives the index, as in FxEvent::cue; untouched on failure
/// @return FX_OK, FX_ERROR_NOT_FOUND (the message states the nearest name), FX_ERROR_INVALID_ARGUMENT,
///         FX_ERROR_STALE_ID, FX_ERROR_RE_ENTRANT
FX_API FxResult fxFindPresetCue(FxContext* context, FxPresetId preset, const char* name, uint32_t* outCue);

#ifdef __cplusplus
}
#endif

#endif
