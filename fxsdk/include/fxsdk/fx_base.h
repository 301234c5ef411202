/// @file fx_base.h
/// Base of all other headers of the C API: export macro, version, result codes, ids and time.
///
/// Threads: everything here may be called from any thread.
/// Ownership: all strings returned here belong to the library. The caller frees none of them.
///
/// Conventions of the whole API
///   Units       meter, second, kilogram, kelvin, cd/m2. Light is linear Rec. 709.
///   Axes        right-handed, +Y up; a camera looks along -Z. Matrices are float[16], column-major.
///   Host world  FxContextDef states other units of length and other axes. Then [m], [m/s], [m/s2] and
///               [m2] count units of the host instead of meters, and positions, directions, rotations and
///               matrices are in axes of the host, in arguments, results and snapshots. Ranges are stated in
///               meters. Photometric values ([cd], [lx], [cd/m2]), preset files, saved states and textures
///               do not depend on units and axes of the host. See docs/howto/units-and-axes.md.
///   Errors      a failed call changes nothing and leaves its outputs untouched. fxGetLastErrorMessage()
///               returns its message on the same thread. The library never prints, aborts or throws.
///   Structs     every definition starts with structSize and grows only at its end. A shorter
///               struct, from an older header, is completed with defaults. A longer struct is accepted
///               only if its unknown members are zero.
///   Thread tags [any] any thread; [scene thread] the thread of the scene; [GL thread] the thread on which
///               the context's OpenGL context is current. Another thread gets FX_ERROR_WRONG_THREAD.
///   Callbacks run inside the API call that needs their result. If a callback calls a function of the same
///               object, the function fails with FX_ERROR_RE_ENTRANT.
#ifndef FXSDK_FX_BASE_H
#define FXSDK_FX_BASE_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(FXSDK_BUILDING)
#define FX_API __declspec(dllexport)
#elif defined(_WIN32)
#define FX_API __declspec(dllimport)
#else
#define FX_API __attribute__((visibility("default")))
#endif

/// Version of this header. The library keeps source and binary compatibility within one major number.
#define FX_VERSION_MAJOR 0
#define FX_VERSION_MINOR 1
#define FX_VERSION_PATCH 0
/// The version as one number: major * 65536 + minor * 256 + patch.
#define FX_VERSION (FX_VERSION_MAJOR * 65536 + FX_VERSION_MINOR * 256 + FX_VERSION_PATCH)

/// Ticks of scene time in a second. The number is divisible by 24, 25, 30, 48, 60, 90, 120, 144 and 240.
#define FX_TICKS_PER_SECOND INT64_C(705600000)

/// Initializer that sets every member of a struct to zero, in C and in C++.
// clang-format off
#ifdef __cplusplus
#define FX_ZEROED {}
#else
#define FX_ZEROED {0}
#endif
// clang-format on

#ifdef __cplusplus
extern "C" {
#endif

/// Outcome of a call. 0 is success, every error is negative. Numbers never change their meaning.
typedef enum FxResult
{
    FX_OK = 0,
    FX_ERROR_INVALID_ARGUMENT = -1, ///< an argument is null, not finite, or outside its range
    FX_ERROR_STALE_ID = -2,        ///< the object of an id never existed, was destroyed, or has another owner
    FX_ERROR_WRONG_THREAD = -3,    ///< called from a thread that the function's tag forbids
    FX_ERROR_OUT_OF_MEMORY = -4,   ///< the allocator returned null
    FX_ERROR_CAPACITY = -5,        ///< a stated capacity is used up
    FX_ERROR_NOT_FOUND = -6,       ///< a file, an asset or a name does not exist
    FX_ERROR_TOO_LARGE = -7,       ///< an input exceeds its documented size limit and was not read
    FX_ERROR_PARSE = -8,           ///< a text is not well formed
    FX_ERROR_SCHEMA = -9,          ///< a preset is well-formed JSON but violates its schema
    FX_ERROR_VERSION = -10,        ///< the version of a struct, preset or header is not supported
    FX_ERROR_GL_UNSUPPORTED = -11, ///< the GL context lacks a version or function that is required
    FX_ERROR_GL_FAILED = -12,      ///< GL refused a shader, a framebuffer or an allocation
    FX_ERROR_NO_GL = -13,          ///< the context was created without GL, so it cannot draw
    FX_ERROR_RE_ENTRANT = -14,     ///< a callback called a function of the object that runs the callback
    FX_ERROR_IO = -15,             ///< the operating system refused to read or write
    FX_ERROR_INTERRUPTED = -16,    ///< the user stopped the operation
    FX_ERROR_HOST_ANSWER = -17,    ///< a callback of the host returned an invalid value
    FX_ERROR_GL_LOST = -18,        ///< the GL context is lost; see fxContext_RestoreGl()
    FX_ERROR_INTERNAL = -99,       ///< a defect of the library
    FX_RESULT_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never returned
} FxResult;

/// Names one preset of one context. All-zero means "none". Functions detect a stale id and never use
/// another object in its place.
typedef struct FxPresetId
{
    uint64_t bits; ///< opaque; differs from run to run
} FxPresetId;

/// Names one instance of one scene. All-zero means "none". Functions detect a stale id.
typedef struct FxInstanceId
{
    uint64_t bits; ///< opaque; differs from run to run
} FxInstanceId;

/// Names one acquired snapshot of one scene. All-zero means "none". Functions detect a stale id.
typedef struct FxSnapshotId
{
    uint64_t bits; ///< opaque; differs from run to run
} FxSnapshotId;

/// Owns presets, scenes and views; see fx_context.h.
typedef struct FxContext FxContext;
/// A list of effect instances with a clock; see fx_scene.h.
typedef struct FxScene FxScene;
/// Renders a scene; see fx_view.h.
typedef struct FxView FxView;

/// Version of the library that is loaded, in the form of FX_VERSION. [any]
FX_API uint32_t fxGetVersion(void);

/// The name of a result, such as "invalid-argument"; "unknown" for a number that is not a result. [any]
/// @return a constant string, never null
FX_API const char* fxResultName(FxResult result);

/// Message of the last failed call on this thread: the function, the argument and the remedy. Successful
/// calls do not change it. [any]
/// @return UTF-8 text, empty when no call of this thread has failed; valid until the next failure on this
///         thread
FX_API const char* fxGetLastErrorMessage(void);

#ifdef __cplusplus
}
#endif

#endif
