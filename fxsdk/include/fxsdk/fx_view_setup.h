/// @file fx_view_setup.h
/// Fills the camera of a frame, and exposure and light of a view. Include this in a program that has no
/// camera or no light of its own: a first effect, a test, a viewer of presets.
///
/// Threads: everything here may be called from any thread.
#ifndef FXSDK_FX_VIEW_SETUP_H
#define FXSDK_FX_VIEW_SETUP_H

#include "fxsdk/fx_base.h"
#include "fxsdk/fx_view.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Points the camera of a frame at a place: sets `origin`, `view` and `projection` for a perspective without
/// a far plane. The up axis of the context is up in the picture; if the camera looks straight up or down, the
/// right axis of the context is to the right. Positions and distances are in units and axes of the context.
/// [any]
/// @param eye          [m] each component within +-1e9
/// @param target       [m] as `eye`, at least 1e-6 m away from it
/// @param fovY         [rad] 0.01..3.1, vertical field of view
/// @param nearDistance [m] 1e-4..1e6, distance of the near plane. For a frame with depth, the near plane and
///                     the depth must be those of the camera that drew it
/// @param ioFrame      structSize, width, height, depthConvention and zeroToOne must be set. Members other
///                     than origin, view and projection keep their values, and on failure all do
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null, or a value out of range, which the message names),
///         FX_ERROR_VERSION (structSize)
FX_API FxResult fxSetFrameCamera(FxContext* context, const double eye[3], const double target[3], float fovY,
                                 float nearDistance, FxFrameDef* ioFrame);

/// Points the camera of a frame at an instance. The camera is that of the author of its preset
/// (FxPresetPreview), moved, turned and scaled with the instance. If the preset has no camera, it stands in
/// front of the instance, somewhat above, where it sees nearly all media and particles that the last update
/// has shown, with a field of view of 50 degrees. [scene thread]
/// @param nearDistance [m] as of fxSetFrameCamera()
/// @param ioFrame      as of fxSetFrameCamera()
/// @return the codes of fxSetFrameCamera(), FX_ERROR_STALE_ID, FX_ERROR_NOT_FOUND (the preset has no camera,
///         and the instance shows nothing), FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT,
///         FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxScene_SetFrameCamera(FxScene* scene, FxInstanceId instance, float nearDistance,
                                       FxFrameDef* ioFrame);

/// Sets what the picture of a preset depends on, so that it looks as its author shows it: exposureEv100,
/// sunDirection, sunIlluminance, skyLuminance and groundAlbedo are those of FxPresetPreview, composition is
/// FX_COMPOSITION_AUTOMATIC and multipleScattering is 3, as the preset requests. [any]
/// @param ioSettings structSize must be set. Other members keep their values, and on failure all do
/// @return the codes of fxGetPresetPreview()
FX_API FxResult fxSetPreviewSettings(FxContext* context, FxPresetId preset, FxViewSettings* ioSettings);

#ifdef __cplusplus
}
#endif

#endif
