/// @file fx_context.h
/// A context holds the host's hooks, the loaded presets and the GPU programs. Include this to start and
/// stop fxsdk.
///
/// Threads: a context may be used from any thread unless a function says otherwise. A function that uses
/// OpenGL is called on the GL thread: the thread that created the context, or the last thread that called
/// fxContext_AdoptGlThread(). Contexts are independent. Ownership: the caller owns the FxContext*; destroying
/// it destroys its presets, scenes and views.
#ifndef FXSDK_FX_CONTEXT_H
#define FXSDK_FX_CONTEXT_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Memory functions of the host. Set both functions or none; without them the C++ runtime allocates. Several
/// threads may call the functions at once, for example while one thread loads a preset and another thread
/// advances a scene.
typedef struct FxAllocator
{
    /// Passed to the callbacks unchanged.
    void* user;

    /// @param size [byte] > 0 @param alignment a power of two, at most 4096
    /// @return memory, or null when it is exhausted
    void* (*allocate)(void* user, size_t size, size_t alignment);

    /// @param memory not null @param size, alignment the values passed to allocate()
    void (*release)(void* user, void* memory, size_t size, size_t alignment);
} FxAllocator;

/// Processes the indices [begin, end) of a parallel loop. May run on any thread of the host.
typedef void (*FxLoopBody)(void* argument, uint32_t begin, uint32_t end);

/// The host's parallel loop. If `run` is null, the library uses its own threads.
typedef struct FxParallelFor
{
    /// Passed to the callbacks unchanged.
    void* user;

    /// Must call `body` for ranges that cover every index in [0, count) exactly once. Each range has at least
    /// minBatch indices; only the last range may be shorter. The function must return when all calls of
    /// `body` have returned. Results depend neither on how the range is divided nor on the number of threads.
    void (*run)(void* user, uint32_t count, uint32_t minBatch, FxLoopBody body, void* argument);
} FxParallelFor;

/// Severity of a log message.
typedef enum FxLogLevel
{
    FX_LOG_INFO = 0,                   ///< information such as the name of the GL renderer
    FX_LOG_WARNING = 1,                ///< the result may differ from the request
    FX_LOG_ERROR = 2,                  ///< a call failed; the call also returned a result code
    FX_LOG_LEVEL_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never sent
} FxLogLevel;

/// Receives log messages. If `write` is null, messages are discarded. `write` is called on the thread of the
/// API call that logs.
typedef struct FxLog
{
    /// Passed to the callbacks unchanged.
    void* user;

    /// @param message UTF-8, valid during the call
    void (*write)(void* user, FxLogLevel level, FxResult code, const char* message);
} FxLog;

/// Loads OpenGL functions. If `getProcAddress` is null, the context has no GL: it supports simulation and
/// snapshots only. fxGetGlProcAddress() suits most hosts.
typedef struct FxGlLoader
{
    /// Passed to the callbacks unchanged.
    void* user;

    /// @param name such as "glCreateTextures" @return the function's address, or null when it does not
    ///          exist
    void* (*getProcAddress)(void* user, const char* name);
} FxGlLoader;

/// Finds preset files for hosts with an archive of their own. If `open` is null, only the file system is
/// searched. For every relative name without ".." that is passed to fxLoadPresetFile(), `open` is called
/// before the file system is searched.
typedef struct FxAssetHook
{
    /// Passed to the callbacks unchanged.
    void* user;

    /// @param name relative, '/'-separated, without ".." @param outSize [byte] receives the length
    /// @return the bytes, or null when the asset does not exist
    const void* (*open)(void* user, const char* name, size_t* outSize);

    /// Called once for every successful open, with the returned data and its size.
    void (*close)(void* user, const void* data, size_t size);
} FxAssetHook;

/// Options of a context.
typedef enum FxContextFlag
{
    /// A missing or damaged image or mesh of a preset causes a warning, and a magenta checkerboard or a
    /// tetrahedron replaces it. Without this flag, loading such a preset fails.
    FX_CONTEXT_PLACEHOLDERS = 1
} FxContextFlag;

/// A direction along an axis of the host's world.
typedef enum FxAxis
{
    FX_AXIS_X = 0,                ///< along +X
    FX_AXIS_Y = 1,                ///< along +Y
    FX_AXIS_Z = 2,                ///< along +Z
    FX_AXIS_NEGATIVE_X = 3,       ///< along -X
    FX_AXIS_NEGATIVE_Y = 4,       ///< along -Y
    FX_AXIS_NEGATIVE_Z = 5,       ///< along -Z
    FX_AXIS_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never valid
} FxAxis;

/// Definition of a new context. Fill with fxDefaultContextDef(), then change members.
typedef struct FxContextDef
{
    /// Set by fxDefaultContextDef(); do not touch.
    uint32_t structSize;

    /// Set by fxDefaultContextDef(): FX_VERSION of the header the caller was built with.
    uint32_t headerVersion;

    /// Default: the C++ runtime's allocator.
    FxAllocator allocator;

    /// Default: the library's own threads.
    FxParallelFor parallelFor;

    /// Default: messages are discarded.
    FxLog log;

    /// Default: no GL.
    FxGlLoader gl;

    /// Default: the file system.
    FxAssetHook assets;

    /// Maximum number of threads without parallelFor, 0..256, limited to the hardware threads of the
    /// machine; 0 (default): all hardware threads.
    uint32_t workers;

    /// Sum of FxContextFlag values; default 0.
    uint32_t flags;

    /// [1/m] 1e-3..1e6, number of the host's units of length in a meter: 1 (default) for meters, 100 for
    /// centimeters, 39.3700787 for inches. All lengths and velocities of the API count these units.
    double unitsPerMeter;

    /// FxAxis that points to the right in the host's world; default FX_AXIS_X. Right, up and forward are
    /// along three different axes, and state whether the world is right-handed or left-handed. The defaults
    /// are the axes of the library: right-handed, +Y up. docs/howto/units-and-axes.md lists the values for
    /// engines.
    uint32_t rightAxis;

    /// FxAxis that points up; default FX_AXIS_Y.
    uint32_t upAxis;

    /// FxAxis that points forward; default FX_AXIS_NEGATIVE_Z. Of an effect without rotation, -Z of its
    /// preset points there.
    uint32_t forwardAxis;

    /// Reserved; 0.
    uint32_t reserved;
} FxContextDef;

/// The definition of a context that simulates on the library's own threads, without GL, in meters and with +Y
/// up.
static inline FxContextDef fxDefaultContextDef(void)
{
    FxContextDef def = FX_ZEROED;
    def.structSize = sizeof(FxContextDef);
    def.headerVersion = FX_VERSION;
    def.unitsPerMeter = 1.0;
    def.rightAxis = FX_AXIS_X;
    def.upAxis = FX_AXIS_Y;
    def.forwardAxis = FX_AXIS_NEGATIVE_Z;
    return def;
}

/// Contents and memory of a context. Fill structSize with sizeof before the call.
typedef struct FxMemoryStats
{
    uint32_t structSize;      ///< set by the caller
    uint32_t presets;         ///< number of loaded presets
    uint32_t scenes;          ///< number of existing scenes
    uint32_t views;           ///< number of existing views
    uint64_t bytesInUse;      ///< [byte] memory that is allocated and not yet released
    uint64_t allocationCount; ///< number of allocations since the context was created

    /// [byte] memory of all reservations of all scenes, a part of bytesInUse; see fx_reserve.h.
    uint64_t bytesReserved;

    /// [byte] voxels of played volume sequences, with their coarser levels, that are held or being read.
    uint64_t sequenceBytes;

    /// Number of times that a frame of a volume sequence was read from its file while it played.
    uint64_t sequenceFramesRead;

    /// Number of times that a view found a frame of a volume sequence missing, because it was not read yet.
    /// The view then draws the balls that stand for it (docs/howto/volumes.md).
    uint64_t sequenceFramesLate;

    /// Number of frames of volume sequences that could not be read. They are not tried again.
    uint64_t sequenceFramesFailed;
} FxMemoryStats;

/// Finds an OpenGL function by the window system whose context is current on this thread: EGL, GLX or SDL, as
/// the process has loaded them. For FxGlLoader::getProcAddress of hosts without a loader of their own. [any]
/// @param user not used
/// @param name such as "glCreateTextures"
/// @return the function's address; null if no context is current or the function does not exist
FX_API void* fxGetGlProcAddress(void* user, const char* name);

/// Creates a context. [any; with GL: on the thread where the OpenGL 4.5 context is current, which becomes
/// the context's GL thread]
/// @param outContext receives the context; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (the message names the member and the remedy), FX_ERROR_VERSION
///         (header of another major number), FX_ERROR_GL_UNSUPPORTED (the message names the version or
///         function), FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxCreateContext(const FxContextDef* def, FxContext** outContext);

/// Destroys a context with all objects in it. Pointers and ids of these objects are invalid afterwards. Null
/// is allowed and does nothing. No other call on an object of the context may be in progress: wait until the
/// threads of all loads have returned from fxPresetLoad_Run(), and let none begin. Callbacks during the call,
/// such as FxAllocator::release, must not use objects of the context; the context refuses such calls.
/// [GL thread when it has GL, else any]
/// @return FX_OK, FX_ERROR_WRONG_THREAD or FX_ERROR_RE_ENTRANT (in a callback, or a load runs or waits for
///         another one; nothing was destroyed)
FX_API FxResult fxDestroyContext(FxContext* context);

/// Compiles all GPU programs of all views, so that no frame compiles programs. Further calls cost nothing.
/// [GL thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_NO_GL, FX_ERROR_GL_FAILED (the message has the
///         compiler's log), FX_ERROR_GL_LOST, FX_ERROR_WRONG_THREAD, FX_ERROR_OUT_OF_MEMORY. After a failure
///         the function may be called again.
FX_API FxResult fxContext_WarmUp(FxContext* context);

/// Makes the calling thread the GL thread. The OpenGL context must already be current on this thread. No GL
/// call of this context may be in progress on another thread. [any]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_NO_GL, FX_ERROR_RE_ENTRANT
FX_API FxResult fxContext_AdoptGlThread(FxContext* context);

/// States that the OpenGL context of the GL thread is lost, or is going to be destroyed. From then on the
/// library calls no function of OpenGL, and fxView_Render(), fxView_RenderStereo(), fxView_PrepareLights()
/// and fxContext_WarmUp() return FX_ERROR_GL_LOST, until fxContext_RestoreGl() is called. Simulation,
/// settings, masks, ids and snapshots do not depend on the loss. Views notice a loss by themselves, by
/// GL_CONTEXT_LOST, and once in a frame by glGetGraphicsResetStatus if the context was created with
/// GL_LOSE_CONTEXT_ON_RESET. A host that knows of the loss, or destroys its OpenGL context on purpose, calls
/// this function before. [GL thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_NO_GL, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxContext_ReportGlLoss(FxContext* context);

/// Goes on in another OpenGL context, which is current on the calling thread. Objects of the last one are
/// forgotten, not deleted: they end with it. All views keep their handle, scene, settings and lights. Their
/// next frame creates the GL objects anew, and compiles programs unless fxContext_WarmUp() is called before.
/// That frame is, bit for bit, the first frame of a new view with the same settings: the adaptation of glare,
/// impostors, displacements since the last frame, prepared frames and frames of several ranges begin anew.
/// Particles that the GPU computes are computed again from their births, as in every new view. A context that
/// is not lost may be left, too. [GL thread; after fxContext_AdoptGlThread(), if the new context is current
/// on another thread]
/// @param gl loader of the new context; null: the loader that fxCreateContext() was given
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_NO_GL (the context was created without GL),
///         FX_ERROR_GL_UNSUPPORTED (as fxCreateContext), FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT,
///         FX_ERROR_OUT_OF_MEMORY. After a failure the context is as before, and the function may be called
///         again.
FX_API FxResult fxContext_RestoreGl(FxContext* context, const FxGlLoader* gl);

/// Reads the counters of the context. [any]
/// @param ioStats structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize)
FX_API FxResult fxContext_GetMemoryStats(FxContext* context, FxMemoryStats* ioStats);

#ifdef __cplusplus
}
#endif

#endif
