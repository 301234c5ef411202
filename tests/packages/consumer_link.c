/* A development build of a game in C: opens a live link, updates a frame, and closes it. */
#include <fxsdk/fx_livelink.h>
#include <fxsdk/fxsdk.h>
#include <stdio.h>

int main(void)
{
    FxContextDef contextDef = fxDefaultContextDef();
    FxSceneDef sceneDef = fxDefaultSceneDef();
    FxLiveLinkDef linkDef = fxDefaultLiveLinkDef();
    FxContext* context = NULL;
    FxScene* scene = NULL;
    FxLiveLink* link = NULL;
    char address[256];
    size_t size = 0;
    linkDef.name = "consumer";
    if (fxCreateContext(&contextDef, &context) || fxCreateScene(context, &sceneDef, &scene)) {
        fprintf(stderr, "%s\n", fxGetLastErrorMessage());
        return 1;
    }
    if (fxCreateLiveLink(context, &linkDef, &link) || fxLiveLink_Update(link, &scene, 1) ||
        fxLiveLink_GetAddress(link, address, sizeof address, &size))
    {
        fprintf(stderr, "%s\n", fxGetLiveLinkErrorMessage());
        return 1;
    }
    printf("listens at %s\n", address);
    fxDestroyLiveLink(link);
    return fxDestroyContext(context);
}
