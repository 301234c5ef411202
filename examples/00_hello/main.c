/* The first effect: an explosion. hello_window.h stands for the window that a game already has. */
#include "fxsdk/fxsdk.h"
#include "hello_window.h"

int main(int argumentCount, char** arguments)
{
    HelloWindow* window = helloOpen(argumentCount, arguments);
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.gl.getProcAddress = helloGetProcAddress;
    contextDef.gl.user = window;
    FxSceneDef sceneDef = fxDefaultSceneDef();
    FxInstanceDef instanceDef = fxDefaultInstanceDef();
    FxViewSettings settings = fxDefaultViewSettings();
    settings.toneMap = 1;
    FxContext* context = NULL;
    FxScene* scene;
    FxInstanceId instance;
    FxView* view;
    if (!window || fxCreateContext(&contextDef, &context) || fxContext_WarmUp(context) ||
        fxLoadPresetLibrary(context, "explosion", &instanceDef.preset) ||
        fxSetPreviewSettings(context, instanceDef.preset, &settings) ||
        fxCreateScene(context, &sceneDef, &scene) || fxScene_CreateInstance(scene, &instanceDef, &instance) ||
        fxCreateView(context, scene, &settings, &view))
        return helloFail(fxGetLastErrorMessage());
    for (FxFrameDef frame = fxDefaultFrameDef(); helloBeginFrame(window, &frame); helloEndFrame(window))
        if (fxScene_Update(scene, frame.deltaTime) || fxView_Render(view, &frame))
            return helloFail(fxGetLastErrorMessage());
    fxDestroyContext(context);
    return helloClose(window);
}
