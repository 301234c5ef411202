// 01_render_to_file PRESET SECONDS OUTPUT.png
//
// Draws an effect at a moment of its life into a texture of its own, without a window. PRESET is the name of
// a library preset or the path of a *.fx.json file. Shows: a headless context, daylight, simulating ahead,
// reading back.
#include "fxsdk/fxsdk.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/image/image.h"
#include "rendering/platform/gl_context.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kStep = 1.0 / 60.0; // [s]

void check(FxResult result)
{
    if (result != FX_OK)
        throw std::runtime_error(fxGetLastErrorMessage());
}

template <class T>
T take(fx::base::Result<T> result)
{
    if (!result)
        throw std::runtime_error(result.status().message());
    return std::move(*result);
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

/// From 12 m away and 2 m up, about 53 degrees of height, nothing in the far distance.
FxFrameDef camera(const fx::render::GlTexture& color)
{
    FxFrameDef frame = fxDefaultFrameDef();
    frame.origin[1] = 2.0;
    frame.origin[2] = 12.0;
    frame.projection[0] = 2.0f * float(kHeight) / float(kWidth);
    frame.projection[5] = 2.0f;
    frame.projection[10] = frame.projection[11] = -1.0f; // infinite far plane, near plane at 0.1 m
    frame.projection[14] = -0.2f;
    frame.projection[15] = 0.0f;
    frame.colorTexture = color.name();
    frame.width = kWidth;
    frame.height = kHeight;
    return frame;
}

void writePng(const std::string& path, const std::vector<float>& rgb)
{
    fx::image::Image image{kWidth, kHeight, 3, {}};
    for (int y = kHeight - 1; y >= 0; --y) // GL's rows begin at the bottom
        image.pixels.insert(image.pixels.end(), rgb.begin() + y * kWidth * 3,
                            rgb.begin() + (y + 1) * kWidth * 3);
    const std::vector<std::byte> png = take(fx::image::writePng(image));
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(png.data()), std::streamsize(png.size()));
    if (!file.flush())
        throw std::runtime_error("cannot write " + path);
}

void run(const std::string& preset, double seconds, const std::string& output)
{
    auto gl = take(fx::render::createEglContext({}));
    auto device = take(fx::render::GlDevice::create(gl->loader(), std::pmr::get_default_resource()));
    const auto color = take(fx::render::GlTexture::create(*device, kWidth, kHeight, GL_RGBA32F, "picture"));
    const float sky[4] = {0.30f, 0.38f, 0.50f, 1.0f}; // exposed values
    device->gl.ClearTexImage(color.name(), 0, GL_RGBA, GL_FLOAT, sky);

    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.gl = {gl->loader().user, gl->loader().getProcAddress};
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
    const FxFrameDef frame = camera(color);
    check(fxView_Render(view, &frame));
    writePng(output, fx::render::readTexture(*device, color.name(), kWidth, kHeight, 3));
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
