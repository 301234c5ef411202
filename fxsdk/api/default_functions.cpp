// The functions of fx_defaults.h.
#include "fxsdk/api/guarded.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/fx_defaults.h"

namespace {

template <class T>
FxResult fill(const char* function, const T& defaults, T* io, const char* name)
{
    return fx::api::guarded(function, nullptr, [&] { return fx::api::writeStruct(defaults, io, name); });
}

} // namespace

FxResult fxGetDefaultContextDef(FxContextDef* ioDef)
{
    return fill(__func__, fxDefaultContextDef(), ioDef, "ioDef");
}

FxResult fxGetDefaultSceneDef(FxSceneDef* ioDef)
{
    return fill(__func__, fxDefaultSceneDef(), ioDef, "ioDef");
}

FxResult fxGetDefaultInstanceDef(FxInstanceDef* ioDef)
{
    return fill(__func__, fxDefaultInstanceDef(), ioDef, "ioDef");
}

FxResult fxGetDefaultInstanceParameters(FxInstanceParameters* ioParameters)
{
    return fill(__func__, fxDefaultInstanceParameters(), ioParameters, "ioParameters");
}

FxResult fxGetDefaultViewSettings(FxViewSettings* ioSettings)
{
    return fill(__func__, fxDefaultViewSettings(), ioSettings, "ioSettings");
}

FxResult fxGetDefaultFrameDef(FxFrameDef* ioDef)
{
    return fill(__func__, fxDefaultFrameDef(), ioDef, "ioDef");
}

FxResult fxGetDefaultLight(FxLight* ioLight)
{
    return fill(__func__, fxDefaultLight(), ioLight, "ioLight");
}

FxResult fxGetDefaultFocus(FxFocus* ioFocus)
{
    return fill(__func__, fxDefaultFocus(), ioFocus, "ioFocus");
}

FxResult fxGetDefaultActivationHints(FxActivationHints* ioHints)
{
    return fill(__func__, fxDefaultActivationHints(), ioHints, "ioHints");
}

FxResult fxGetDefaultBudget(FxBudget* ioBudget)
{
    return fill(__func__, fxDefaultBudget(), ioBudget, "ioBudget");
}

FxResult fxGetDefaultCollisionMesh(FxCollisionMesh* ioMesh)
{
    return fill(__func__, fxDefaultCollisionMesh(), ioMesh, "ioMesh");
}

FxResult fxGetDefaultContactHook(FxContactHook* ioHook)
{
    return fill(__func__, fxDefaultContactHook(), ioHook, "ioHook");
}

FxResult fxGetDefaultMotion(FxMotion* ioMotion)
{
    return fill(__func__, fxDefaultMotion(), ioMotion, "ioMotion");
}
