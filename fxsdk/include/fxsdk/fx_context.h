/// @file fx_context.h
/// A context holds the host's hooks, the loaded presets and the GPU programs. Include this to start and
/// stop fxsdk.
///
/// Threads: a context may be used from any thread unless a function says otherwise. A function that uses
/// OpenGL is called on the GL thread: the thread that created the context, until fxContext_AdoptGlThread()
/// changes it. Contexts are independent. Ownership: the caller owns the FxContext*; destroying it destroys
/// its presets, scenes and views.
#ifndef FXSDK_FX_CONTEXT_H
#define FXSDK_FX_CONTEXT_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Memory functions of the host. Set both or none; without them the C++ runtime allocates. They are called
/// from several threads at once when one thread loads a preset while another advances a scene.
typedef struct FxAllocator
{
    /// Passed back unchanged.
    void* user;

    /// @param size [byte] > 0 @param alignment a power of two, at most 4096
    /// @return memory, or null when it is exhausted
    void* (*allocate)(void* user, size_t size, size_t alignment);

    /// @param memory not null @param size, alignment the values that allocated it
    void (*release)(void* user, void* memory, size_t size, size_t alignment);
} FxAllocator;

/// Processes the indices [begin, end) of a parallel loop. May run on any thread of the host.
typedef void (*FxLoopBody)(void* argument, uint32_t begin, uint32_t end);

/// The host's parallel loop; null means the library's own threads.
typedef struct FxParallelFor
{
    /// Passed back unchanged.
    void* user;

    /// Must call body so that every index in [0, count) is covered exactly once, by ranges of at least
    /// minBatch indices (the last may be shorter), and return when all of these calls have returned.
    /// Results depend neither on how the range is divided nor on the number of threads.
    void (*run)(void* user, uint32_t count, uint32_t minBatch, FxLoopBody body, void* argument);
} FxParallelFor;

/// Severity of a log message.
typedef enum FxLogLevel
{
    FX_LOG_INFO = 0,                   ///< information such as the name of the GL renderer
    FX_LOG_WARNING = 1,                ///< the result may differ from the request
    FX_LOG_ERROR = 2,                  ///< a call failed; it also returned a code
    FX_LOG_LEVEL_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never sent
} FxLogLevel;

/// Receives log messages; null discards them. Called on the thread of the API call that logs.
typedef struct FxLog
{
    /// Passed back unchanged.
    void* user;

    /// @param message UTF-8, valid during the call
    void (*write)(void* user, FxLogLevel level, FxResult code, const char* message);
} FxLog;

/// Loads OpenGL functions; null creates a context without GL, for simulation and snapshots only.
typedef struct FxGlLoader
{
    /// Passed back unchanged.
    void* user;

    /// @param name such as "glCreateTextures" @return the function's address, or null when it does not
    ///          exist
    void* (*getProcAddress)(void* user, const char* name);
} FxGlLoader;

/// Finds preset files for hosts with an archive of their own; null means the file system. It is called
/// before the file system for every relative name without ".." that is passed to fxLoadPresetFile().
typedef struct FxAssetHook
{
    /// Passed back unchanged.
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

/// How a context starts. Fill with fxDefaultContextDef(), then change what you need.
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

    /// FxContextFlag, added up; default 0.
    uint32_t flags;
} FxContextDef;

/// The definition of a context that simulates on the library's own threads, without GL.
static inline FxContextDef fxDefaultContextDef(void)
{
    FxContextDef def = FX_ZEROED;
    def.structSize = sizeof(FxContextDef);
    def.headerVersion = FX_VERSION;
    return def;
}

/// Contents and memory of a context. Fill structSize with sizeof before the call.
typedef struct FxMemoryStats
{
    uint32_t structSize;      ///< set by the caller
    uint32_t presets;         ///< number of loaded presets
    uint32_t scenes;          ///< number of existing scenes
    uint32_t views;           ///< number of existing views
    uint64_t bytesInUse;      ///< [byte] taken from the allocator and not given back
    uint64_t allocationCount; ///< number of allocations since the context was created
} FxMemoryStats;

/// Creates a context. [any; with GL: on the thread where the OpenGL 4.5 context is current, which becomes
/// the context's GL thread]
/// @param outContext receives the context; untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (header of another major number),
///         FX_ERROR_GL_UNSUPPORTED (the message names the version or function), FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxCreateContext(const FxContextDef* def, FxContext** outContext);

/// Destroys a context with all objects in it; its pointers and ids are invalid afterwards. Null is allowed
/// and does nothing. No other call on an object of the context may be in progress. Callbacks during the
/// call, such as FxAllocator::release, must not use objects of the context; the context refuses such calls.
/// [GL thread when it has GL, else any]
/// @return FX_OK, FX_ERROR_WRONG_THREAD or FX_ERROR_RE_ENTRANT (nothing was destroyed)
FX_API FxResult fxDestroyContext(FxContext* context);

/// Compiles all GPU programs of all views, so that no frame compiles programs. Further calls cost nothing.
/// [GL thread]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_NO_GL, FX_ERROR_GL_FAILED (the message has the
///         compiler's log), FX_ERROR_WRONG_THREAD, FX_ERROR_OUT_OF_MEMORY. After a failure it may be called
///         again.
FX_API FxResult fxContext_WarmUp(FxContext* context);

/// Makes the calling thread the GL thread: call it after the OpenGL context has become current there. No GL
/// call of this context may be in progress on another thread. [any]
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_NO_GL, FX_ERROR_RE_ENTRANT
FX_API FxResult fxContext_AdoptGlThread(FxContext* context);

/// Reads the counters of the context. [any]
/// @param ioStats structSize must be set; the rest is overwritten on success and untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize)
FX_API FxResult fxContext_GetMemoryStats(FxContext* context, FxMemoryStats* ioStats);

#ifdef __cplusplus
}
#endif

#endif
