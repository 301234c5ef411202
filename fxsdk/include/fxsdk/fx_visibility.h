/// @file fx_visibility.h
/// Reports why an instance is seen or not. Include this to find out why nothing is visible.
///
/// Threads: [scene thread], see fx_scene.h.
#ifndef FXSDK_FX_VISIBILITY_H
#define FXSDK_FX_VISIBILITY_H

#include "fxsdk/fx_base.h"
#include "fxsdk/fx_view_frame.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Values of FxVisibility::cause: the first of these that applies, in this order but FX_VISIBILITY_IN_VIEW
/// and FX_VISIBILITY_MASKED.
typedef enum FxVisibilityCause
{
    FX_VISIBILITY_IN_VIEW = 0,      ///< particles are in view; without a camera: particles are published
    FX_VISIBILITY_NOT_STARTED = 1,  ///< its start time has not come, or no update has taken a step since
    FX_VISIBILITY_ENDED = 2,        ///< the effect has ended
    FX_VISIBILITY_HIDDEN = 3,       ///< culling hides it; FxVisibility::reason states why
    FX_VISIBILITY_CATCHING_UP = 4,  ///< its past is being simulated
    FX_VISIBILITY_NO_PARTICLES = 5, ///< it has no particles at this moment
    FX_VISIBILITY_BEHIND = 6,       ///< all particles are before the near plane or behind the camera
    FX_VISIBILITY_BESIDE = 7,       ///< all particles are outside of the frustum, at its sides
    /// The largest group of particles covers less than 1/255 of a pixel.
    FX_VISIBILITY_TOO_SMALL = 8,
    /// The visibility masks of instance and camera share no bit. It comes after FX_VISIBILITY_ENDED.
    FX_VISIBILITY_MASKED = 9,
    FX_VISIBILITY_FORCE_32 = 0x7fffffff ///< makes the type 32 bits wide with every compiler; never returned
} FxVisibilityCause;

/// Where an instance is for a camera, and why it is seen or not. Fill structSize with sizeof before the call.
typedef struct FxVisibility
{
    uint32_t structSize; ///< set by the caller
    uint32_t cause;      ///< FxVisibilityCause
    uint32_t state;      ///< FxInstanceState
    uint32_t reason;     ///< FxActivityReason
    uint32_t particles;  ///< number of particles of the instance

    /// [m] radius of the largest sphere around a group of particles; 0 without particles.
    float radius;

    /// [m] distance from the eye to the center of this sphere; 0 without particles or without a camera.
    float distance;

    /// [pixel] radius of this sphere on the picture, as if it was in view; 0 without particles or camera.
    float pixels;
} FxVisibility;

/// Reports whether particles of an instance are in the view of a camera, and the cause if they are not, as of
/// the last update. Bounds of groups of particles are tested, not single particles. The report does not know
/// surfaces of the host, exposure and lights. [scene thread]
/// @param camera       frame of a view; only origin, view, projection, depthConvention, zeroToOne, height
///                     and visibilityMask are used; null: causes that depend on the camera are not tested
/// @param ioVisibility structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (the message names the member), FX_ERROR_VERSION (structSize),
///         FX_ERROR_STALE_ID, FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT
FX_API FxResult fxScene_ExplainVisibility(FxScene* scene, FxInstanceId instance, const FxFrameDef* camera,
                                          FxVisibility* ioVisibility);

/// Describes a cause and its remedy in one English sentence. [any]
/// @param cause FxVisibilityCause
/// @return a constant string; "unknown cause" for other values
FX_API const char* fxGetVisibilityText(uint32_t cause);

#ifdef __cplusplus
}
#endif

#endif
