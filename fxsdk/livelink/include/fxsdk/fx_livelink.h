/// @file fx_livelink.h
/// A live link lets the effect editor (`fx edit --link`) change presets of a running game. It is a static
/// library of its own, fx_livelink, for development builds on Linux; libfxsdk does not contain it. Nothing is
/// opened before fxCreateLiveLink().
///
/// Threads: the link belongs to the scene thread of its scenes [scene thread]. Presets are read on a thread
/// of the link, so that no frame waits for them; the context's log, allocator and asset hook are then called
/// on that thread too. Ownership: the caller owns the FxLiveLink*, which must be destroyed before its
/// context.
///
/// Access: a Unix socket in a folder that only this user can enter, or TCP on the loopback device with a
/// token. One client at a time; a second one is refused with a message.
#ifndef FXSDK_FX_LIVELINK_H
#define FXSDK_FX_LIVELINK_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A listening socket, and the client that is connected to it.
typedef struct FxLiveLink FxLiveLink;

/// Options of a live link.
typedef enum FxLiveLinkFlag
{
    FX_LIVELINK_TCP = 1, ///< listens on 127.0.0.1 instead of a Unix socket; needs a token
    /// Presets are read within fxLiveLink_Update(), for hosts whose asset hook must not be called on another
    /// thread. A frame then takes as long as the preset takes to load.
    FX_LIVELINK_LOAD_ON_UPDATE = 2
} FxLiveLinkFlag;

/// Definition of a live link. Fill with fxDefaultLiveLinkDef(), then set the name.
typedef struct FxLiveLinkDef
{
    /// Set by fxDefaultLiveLinkDef(); do not touch.
    uint32_t structSize;

    /// Sum of FxLiveLinkFlag values; default 0.
    uint32_t flags;

    /// Name of the game: 1 to 64 letters, digits, '-', '_' and '.'; required.
    const char* name;

    /// File of the socket, at most 107 bytes; null (default): NAME-PID.sock in the folder
    /// $XDG_RUNTIME_DIR/fxsdk, or /tmp/fxsdk-UID without that variable. The folder is made with mode 0700; a
    /// folder that others can enter is refused.
    const char* socketPath;

    /// Secret that a client must send, 16 to 256 bytes; required with FX_LIVELINK_TCP; null (default): none.
    const char* token;

    /// TCP port, 0..65535; 0 (default): any free one, see fxLiveLink_GetAddress().
    uint32_t port;

    /// [byte] 4,096..2^26, bytes that one update reads at most; default 2^20.
    uint32_t bytesPerUpdate;

    /// [byte] 4,096..2^26, longest message of a client; default 2^24. A longer one closes the connection.
    uint64_t maxMessageBytes;

    /// 1..1000, messages that one update accepts at most; default 16.
    uint32_t messagesPerUpdate;

    /// Reserved; 0.
    uint32_t reserved;
} FxLiveLinkDef;

/// The definition of a Unix socket in the default folder; only its name is missing.
static inline FxLiveLinkDef fxDefaultLiveLinkDef(void)
{
    FxLiveLinkDef def = FX_ZEROED;
    def.structSize = sizeof(FxLiveLinkDef);
    def.bytesPerUpdate = 1u << 20;
    def.maxMessageBytes = 1u << 24;
    def.messagesPerUpdate = 16;
    return def;
}

/// Counters since the link was created. Fill structSize with sizeof before the call.
typedef struct FxLiveLinkStatistics
{
    uint32_t structSize;   ///< set by the caller
    uint32_t hasClient;    ///< 1: a client has said hello
    uint64_t clients;      ///< number of accepted connections
    uint64_t refused;      ///< number of connections refused or closed because of what they sent
    uint64_t messages;     ///< number of complete messages received
    uint64_t errors;       ///< number of messages answered with an error
    uint64_t replacements; ///< number of presets replaced
    uint64_t bytesRead;    ///< [byte]
    uint64_t bytesWritten; ///< [byte]
} FxLiveLinkStatistics;

/// Opens the socket. No client is served before fxLiveLink_Update(). [any]
/// @param context owns the presets that clients may replace
/// @param outLink receives the link; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, out of range, no token with TCP), FX_ERROR_VERSION
///         (structSize), FX_ERROR_IO (the socket or its folder; fxGetLiveLinkErrorMessage() names the cause),
///         FX_ERROR_OUT_OF_MEMORY
FxResult fxCreateLiveLink(FxContext* context, const FxLiveLinkDef* def, FxLiveLink** outLink);

/// Closes the connection and the socket, and waits for a preset that is being loaded. Null is allowed and
/// does nothing. [scene thread]
void fxDestroyLiveLink(FxLiveLink* link);

/// Serves the client. Call it once a frame, before fxScene_Update(), also while the game is paused. It never
/// waits for the client and reads at most FxLiveLinkDef::bytesPerUpdate and messagesPerUpdate. A preset that
/// has been loaded replaces its predecessor in all scenes (fxScene_ReplacePreset()) and behind its id
/// (fxRedirectPreset()). Faults of the client are answered to the client and are no failure of this call.
/// [scene thread]
/// @param scenes scenes of the context with the same scene thread; may be null if count is 0
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null), FX_ERROR_OUT_OF_MEMORY (the connection was closed)
FxResult fxLiveLink_Update(FxLiveLink* link, FxScene* const* scenes, uint32_t count);

/// Reads the address for `fx edit --link`: "unix:PATH" or "tcp:127.0.0.1:PORT". [scene thread]
/// @param buffer   receives UTF-8 text, zero-terminated; null to get only the size
/// @param capacity [byte] of buffer
/// @param outSize  [byte] size of the text with its zero; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_CAPACITY (nothing is written)
FxResult fxLiveLink_GetAddress(FxLiveLink* link, char* buffer, size_t capacity, size_t* outSize);

/// Reads the counters. [scene thread]
/// @param ioStatistics structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize)
FxResult fxLiveLink_GetStatistics(FxLiveLink* link, FxLiveLinkStatistics* ioStatistics);

/// Message of the last failed call of this header on this thread. [any]
/// @return UTF-8 text, empty when no call has failed; valid until the next failure on this thread
const char* fxGetLiveLinkErrorMessage(void);

#ifdef __cplusplus
}
#endif

#endif
