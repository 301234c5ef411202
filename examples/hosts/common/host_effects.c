#include "host_effects.h"

static int add(const HostEffects* effects, const char* name, double x, double y, double z, double seconds)
{
    FxInstanceDef def = fxDefaultInstanceDef();
    FxInstanceId instance;
    def.position[0] = x;
    def.position[1] = y;
    def.position[2] = z;
    def.startTick = (int64_t)(seconds * (double)FX_TICKS_PER_SECOND);
    return fxLoadPresetLibrary(effects->context, name, &def.preset) == FX_OK &&
           fxScene_CreateInstance(effects->scene, &def, &instance) == FX_OK;
}

int hostOpenEffects(HostEffects* effects, const FxGlLoader* gl, const FxViewSettings* settings)
{
    FxContextDef contextDef = fxDefaultContextDef();
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    contextDef.gl = *gl;
    effects->context = NULL;
    return fxCreateContext(&contextDef, &effects->context) == FX_OK &&
           fxCreateScene(effects->context, &sceneDef, &effects->scene) == FX_OK &&
           add(effects, "campfire", -2.6, 0.0, 0.0, 0.0) && add(effects, "sparks", -0.6, 0.3, 2.0, 0.0) &&
           add(effects, "explosion", 3.0, 0.0, -7.0, 1.0) &&
           fxCreateView(effects->context, effects->scene, settings, &effects->view) == FX_OK &&
           fxContext_WarmUp(effects->context) == FX_OK; /* no frame compiles programs */
}

void hostCloseEffects(HostEffects* effects)
{
    fxDestroyContext(effects->context);
    effects->context = NULL;
}
