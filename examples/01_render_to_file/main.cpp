// 01_render_to_file PRESET SECONDS OUTPUT.png
//
// Draws an effect at a moment of its life into a texture of its own, without a window. PRESET is the name of
// a library preset or the path of a *.fx.json file. Shows: a headless context, daylight, simulating ahead,
// reading back.
#include "fxsdk/fxsdk.h"
#include "offscreen_gl.h"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kStep = 1.0 / 60.0; // [s]

void check(FxResult result)
{
    if (result != FX_OK)
        throw std::runtime_error(fxGetLastErrorMessage());
}

FxPresetId load(FxContext* context, const std::string& preset)
{
    FxPresetId id;
    check(preset.ends_with(".json") ? fxLoadPresetFile(context, preset.c_str(), &id)
                                    : fxLoadPresetLibrary(context, preset.c_str(), &id));
    return id;
}

/// A bright afternoon: the sun lights smoke and dust, the exposure is that of a camera outdoors.
FxViewSettings daylight()
{
    FxViewSettings settings = fxDefaultViewSettings();
    for (float& illuminance : settings.sunIlluminance)
        illuminance = 60000.0f;
    for (float& luminance : settings.skyLuminance)
        luminance = 4000.0f;
    settings.exposureEv100 = 13.0f;
    settings.toneMap = 1;
    return settings;
}

/// From 12 m away and 2 m up, about 53 degrees of height.
FxFrameDef camera(FxContext* context, const example::Picture& picture)
{
    FxFrameDef frame = fxDefaultFrameDef();
    frame.colorTexture = picture.color();
    frame.width = kWidth;
    frame.height = kHeight;
    const double eye[3] = {0.0, 2.0, 12.0}, target[3] = {0.0, 2.0, 0.0};
    check(fxSetFrameCamera(context, eye, target, 0.93f, 0.1f, &frame));
    return frame;
}

void run(const std::string& preset, double seconds, const std::string& output)
{
    const example::OffscreenGl gl;
    example::Picture picture(kWidth, kHeight);
    const float sky[4] = {0.30f, 0.38f, 0.50f, 1.0f}; // exposed values
    picture.clear(sky);

    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.gl.getProcAddress = example::findOffscreenFunction;
    FxContext* context = nullptr;
    check(fxCreateContext(&contextDef, &context));
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    FxScene* scene = nullptr;
    check(fxCreateScene(context, &sceneDef, &scene));
    FxInstanceDef instance = fxDefaultInstanceDef();
    instance.preset = load(context, preset);
    FxInstanceId id;
    check(fxScene_CreateInstance(scene, &instance, &id));
    for (double time = 0.0; time < seconds; time += kStep)
        check(fxScene_Update(scene, kStep));

    const FxViewSettings settings = daylight();
    FxView* view = nullptr;
    check(fxCreateView(context, scene, &settings, &view));
    const FxFrameDef frame = camera(context, picture);
    check(fxView_Render(view, &frame));
    picture.writePng(output);
    check(fxDestroyContext(context));
}

} // namespace

int main(int argumentCount, char** arguments)
{
    if (argumentCount != 4) {
        std::fprintf(stderr, "usage: 01_render_to_file PRESET SECONDS OUTPUT.png\n");
        return 2;
    }
    try {
        run(arguments[1], std::strtod(arguments[2], nullptr), arguments[3]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "01_render_to_file: %s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
