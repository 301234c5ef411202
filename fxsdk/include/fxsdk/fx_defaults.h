/// @file fx_defaults.h
/// The default functions of the other headers as functions that the library exports, for languages that
/// cannot call inline functions of C. C and C++ programs use the inline functions, such as
/// fxDefaultContextDef().
///
/// Threads: everything here may be called from any thread.
///
/// Each function fills a struct with its defaults. @param ioDef, ioSettings, ...: structSize must be set; all
/// other members are overwritten on success, untouched on failure. Members that this library does not know
/// are set to zero. @return FX_OK, FX_ERROR_INVALID_ARGUMENT (null), FX_ERROR_VERSION (structSize)
#ifndef FXSDK_FX_DEFAULTS_H
#define FXSDK_FX_DEFAULTS_H

#include "fxsdk/fx_activation.h"
#include "fxsdk/fx_base.h"
#include "fxsdk/fx_collision.h"
#include "fxsdk/fx_context.h"
#include "fxsdk/fx_motion.h"
#include "fxsdk/fx_scene.h"
#include "fxsdk/fx_view.h"
#include "fxsdk/fx_view_lights.h"

#ifdef __cplusplus
extern "C" {
#endif

/// fxDefaultContextDef(), with FX_VERSION of the library as headerVersion. [any]
FX_API FxResult fxGetDefaultContextDef(FxContextDef* ioDef);

/// fxDefaultSceneDef(). [any]
FX_API FxResult fxGetDefaultSceneDef(FxSceneDef* ioDef);

/// fxDefaultInstanceDef(). [any]
FX_API FxResult fxGetDefaultInstanceDef(FxInstanceDef* ioDef);

/// fxDefaultInstanceParameters(). [any]
FX_API FxResult fxGetDefaultInstanceParameters(FxInstanceParameters* ioParameters);

/// fxDefaultViewSettings(). [any]
FX_API FxResult fxGetDefaultViewSettings(FxViewSettings* ioSettings);

/// fxDefaultFrameDef(). [any]
FX_API FxResult fxGetDefaultFrameDef(FxFrameDef* ioDef);

/// fxDefaultLight(). [any]
FX_API FxResult fxGetDefaultLight(FxLight* ioLight);

/// fxDefaultFocus(). [any]
FX_API FxResult fxGetDefaultFocus(FxFocus* ioFocus);

/// fxDefaultActivationHints(). [any]
FX_API FxResult fxGetDefaultActivationHints(FxActivationHints* ioHints);

/// fxDefaultBudget(). [any]
FX_API FxResult fxGetDefaultBudget(FxBudget* ioBudget);

/// fxDefaultCollisionMesh(). [any]
FX_API FxResult fxGetDefaultCollisionMesh(FxCollisionMesh* ioMesh);

/// fxDefaultContactHook(). [any]
FX_API FxResult fxGetDefaultContactHook(FxContactHook* ioHook);

/// fxDefaultMotion(). [any]
FX_API FxResult fxGetDefaultMotion(FxMotion* ioMotion);

#ifdef __cplusplus
}
#endif

#endif
