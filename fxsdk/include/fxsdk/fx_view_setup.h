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

/// Sets exposure and light of a view to those in which the author of a preset shows it, see FxPresetPreview:
/// exposureEv100, sunDirection, sunIlluminance, skyLuminance and groundAlbedo. [any]
/// @param ioSettings structSize must be set. Other members keep their values, and on failure all do
/// @return the codes of fxGetPresetPreview()
FX_API FxResult fxSetPreviewLight(FxContext* context, FxPresetId preset, FxViewSettings* ioSettings);

#ifdef __cplusplus
}
#endif

#endif
