/* A host in C: places an effect of the library and simulates it for a second. Compiled as C99 and as C11. */
#include <fxsdk/fxsdk.h>
#include <stdio.h>

int main(void)
{
    FxContextDef contextDef = fxDefaultContextDef();
    FxSceneDef sceneDef = fxDefaultSceneDef();
    FxInstanceDef instanceDef = fxDefaultInstanceDef();
    FxSceneStatistics statistics = FX_ZEROED;
    FxContext* context = NULL;
    FxScene* scene = NULL;
    FxInstanceId instance;
    int frame;
    statistics.structSize = sizeof statistics;
    if (fxCreateContext(&contextDef, &context) || fxCreateScene(context, &sceneDef, &scene) ||
        fxLoadPresetLibrary(context, "campfire", &instanceDef.preset) ||
        fxScene_CreateInstance(scene, &instanceDef, &instance))
    {
        fprintf(stderr, "%s\n", fxGetLastErrorMessage());
        return 1;
    }
    for (frame = 0; frame < 60; ++frame)
        fxScene_Update(scene, 1.0 / 60.0);
    fxScene_GetStatistics(scene, &statistics);
    printf("%u particles after %u steps\n", (unsigned)statistics.particles, (unsigned)statistics.steps);
    return fxDestroyContext(context) || statistics.particles == 0;
}
