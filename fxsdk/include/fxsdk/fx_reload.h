/// @file fx_reload.h
/// Presets that change while instances of them live. Include this to let a running game show an edited
/// preset, and to list presets and instances for tools. The optional library of fx_livelink.h does all of
/// this over a socket.
///
/// Threads: presets may be loaded and listed on any thread; instances are replaced on the scene thread.
/// Ownership: the caller owns all buffers. A context owns its presets, a scene its instances.
#ifndef FXSDK_FX_RELOAD_H
#define FXSDK_FX_RELOAD_H

#include "fxsdk/fx_base.h"
#include "fxsdk/fx_scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Local time at which an instance continues with another preset.
typedef enum FxReplaceMode
{
    FX_REPLACE_SEEK = 0, ///< the local time that the instance has, as fxScene_SeekInstance() would go to it
    FX_REPLACE_RESTART = 1,               ///< the beginning, as a new instance
    FX_REPLACE_MODE_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never valid
} FxReplaceMode;

/// Facts about one instance, for tools. Fill structSize with sizeof before the call.
typedef struct FxInstanceInfo
{
    /// Set by the caller.
    uint32_t structSize;

    /// FxInstanceState of the instance.
    uint32_t state;

    /// Preset of the instance; its bits are 0 when the preset is no longer loaded.
    FxPresetId preset;

    /// [m] world position of the effect's origin.
    double position[3];

    /// [s] local time; negative before the start, 0 after the end.
    double localSeconds;

    /// Number of living particles.
    uint32_t particles;

    /// Reserved; 0.
    uint32_t reserved;
} FxInstanceInfo;

/// Loads a preset from an edited text of the file `path`, which need not exist. Images and meshes that the
/// preset names are found beside this file, as fxLoadPresetFile() finds them. [any]
/// @param text      UTF-8, need not be zero-terminated; read during the call only
/// @param length    [byte] length of the text, 1 byte to 4 MiB
/// @param path      UTF-8; also the name in messages. "library:NAME": the preset names files of the library
/// @param outPreset receives the id; untouched on failure
/// @return the codes of fxLoadPresetFile()
FX_API FxResult fxLoadPresetTextAt(FxContext* context, const char* text, size_t length, const char* path,
                                   FxPresetId* outPreset);

/// Lets all instances of `oldPreset` in the scene continue with `newPreset`. They keep id, placement, seed,
/// parameters, speed, hints, user data and visibility mask. With FX_REPLACE_SEEK an instance continues at its
/// local time, with the particles of a new instance of `newPreset` that fxScene_SeekInstance() has moved
/// there. Such an instance ends with the next step when `newPreset` ends before that time. Instances that
/// have not started start with `newPreset`. Instances that have ended stay ended. Events of
/// fxScene_TriggerEvent() are not replayed. The past of the new preset gives fxScene_GetEvents() no events;
/// recorded ones keep the cues of the old preset, so read them before.
///
/// The call takes as many steps as FxSceneDef::workBudget allows, for all instances together. The next
/// updates take the remaining steps; until then an instance is FX_INSTANCE_WAKING and not shown. The call
/// completes a step that an update has left incomplete. During the call the memory of both presets is in use.
/// Views show the result after the next fxScene_Update(), even if that update adds 0 s. [scene thread]
/// @param oldPreset may equal newPreset
/// @param mode      FxReplaceMode
/// @param outCount  receives the number of instances that continue; may be null; untouched on failure
/// @return FX_OK (also if the scene has no instance of oldPreset), FX_ERROR_STALE_ID (a preset),
///         FX_ERROR_INVALID_ARGUMENT, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY. A
///         failure leaves all instances as they were.
FX_API FxResult fxScene_ReplacePreset(FxScene* scene, FxPresetId oldPreset, FxPresetId newPreset,
                                      uint32_t mode, uint32_t* outCount);

/// Makes the id `preset` name the effect of the preset `target`. Instances that are created with `preset`
/// from now on have this effect. Existing instances keep theirs; call fxScene_ReplacePreset() first to change
/// them. Both ids stay valid, keep their fxGetPresetSource(), and are unloaded one by one. [any]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_RE_ENTRANT
FX_API FxResult fxRedirectPreset(FxContext* context, FxPresetId preset, FxPresetId target);

/// Lists the presets of a context. [any]
/// @param outPresets receives the ids, in the order of their indices; null to get only the number
/// @param capacity   number of ids that fit into outPresets
/// @param outCount   number of presets; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_CAPACITY (nothing is written), FX_ERROR_RE_ENTRANT
FX_API FxResult fxGetPresets(FxContext* context, FxPresetId* outPresets, uint32_t capacity,
                             uint32_t* outCount);

/// Reads where a preset came from: the path of fxLoadPresetFile() or fxLoadPresetTextAt(), the display name
/// of fxLoadPresetText(), or "library:NAME". [any]
/// @param buffer   receives UTF-8 text, zero-terminated; null to get only the size
/// @param capacity [byte] of buffer
/// @param outSize  [byte] size of the text with its zero; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_CAPACITY (nothing is written),
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxGetPresetSource(FxContext* context, FxPresetId preset, char* buffer, size_t capacity,
                                  size_t* outSize);

/// Reads facts about an instance. Takes time in proportion to the number of presets. [scene thread]
/// @param ioInfo structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_STALE_ID, FX_ERROR_VERSION (structSize),
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_GetInstanceInfo(FxScene* scene, FxInstanceId instance, FxInstanceInfo* ioInfo);

#ifdef __cplusplus
}
#endif

#endif
