/* Places an effect from the library and simulates it for a second. */
#include "fxsdk/fxsdk.h"

#include <stdio.h>

static int fail(const char* what)
{
    fprintf(stderr, "%s: %s\n", what, fxGetLastErrorMessage());
    return 1;
}

int main(void)
{
    FxContextDef contextDef = fxDefaultContextDef();
    FxSceneDef sceneDef = fxDefaultSceneDef();
    FxInstanceDef instanceDef = fxDefaultInstanceDef();
    FxSceneStatistics statistics = {sizeof(FxSceneStatistics)};
    FxContext* context = NULL;
    FxScene* scene = NULL;
    FxInstanceId instance;
    if (fxCreateContext(&contextDef, &context) != FX_OK || fxCreateScene(context, &sceneDef, &scene) != FX_OK)
        return fail("create");
    if (fxLoadPresetLibrary(context, "campfire", &instanceDef.preset) != FX_OK ||
        fxScene_CreateInstance(scene, &instanceDef, &instance) != FX_OK)
        return fail("place");
    for (int frame = 0; frame < 60; ++frame)
        if (fxScene_Update(scene, 1.0 / 60.0) != FX_OK)
            return fail("update");
    if (fxScene_GetStatistics(scene, &statistics) != FX_OK)
        return fail("statistics");
    printf("%u particles after %llu steps\n", statistics.particles, (unsigned long long)statistics.steps);
    fxDestroyContext(context);
    return statistics.particles > 0 ? 0 : 1;
}
