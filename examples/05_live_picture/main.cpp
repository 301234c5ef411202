// 05_live_picture PRESET.fx.json OUTPUT.png [--link NAME] [--frames N]
//
// A game that draws one effect again and again, without a window: OUTPUT.png always holds the last picture.
// With
// --link the effect can be changed while the game runs:
//     05_live_picture torch.fx.json torch.png --link my-game &
//     fx edit torch.fx.json --link my-game
// The lines marked "link" are all that a game needs; a game would compile them in development builds only.
#include "fxsdk/fx_livelink.h" // link
#include "fxsdk/fxsdk.h"
#include "offscreen_gl.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr int kWidth = 480;
constexpr int kHeight = 270;
constexpr double kStep = 1.0 / 60.0;                    // [s]
constexpr float kDusk[4] = {0.02f, 0.03f, 0.05f, 1.0f}; // exposed values

struct Options
{
    std::string preset;
    std::string output;
    std::string link; ///< name of the game; empty: no link
    long frames = 0;  ///< 0: without end
};

void check(FxResult result)
{
    if (result != FX_OK)
        throw std::runtime_error(fxGetLastErrorMessage());
}

void checkLink(FxResult result) // link
{
    if (result != FX_OK)
        throw std::runtime_error(fxGetLiveLinkErrorMessage());
}

Options readOptions(const std::vector<std::string>& arguments)
{
    Options options;
    std::vector<std::string> files;
    for (size_t i = 0; i < arguments.size(); ++i) {
        const bool hasValue = i + 1 < arguments.size();
        if (arguments[i] == "--link" && hasValue)
            options.link = arguments[++i];
        else if (arguments[i] == "--frames" && hasValue)
            options.frames = std::strtol(arguments[++i].c_str(), nullptr, 10);
        else
            files.push_back(arguments[i]);
    }
    if (files.size() != 2)
        throw std::invalid_argument(
            "usage: 05_live_picture PRESET.fx.json OUTPUT.png [--link NAME] [--frames N]");
    options.preset = files[0];
    options.output = files[1];
    return options;
}

/// Late dusk: fires are bright, and smoke is just seen.
FxViewSettings dusk()
{
    FxViewSettings settings = fxDefaultViewSettings();
    for (float& luminance : settings.skyLuminance)
        luminance = 40.0f;
    settings.exposureEv100 = 9.0f;
    settings.toneMap = 1;
    return settings;
}

/// From 6 m away and 1.5 m up, about 53 degrees of height.
FxFrameDef camera(FxContext* context, const example::Picture& picture)
{
    FxFrameDef frame = fxDefaultFrameDef();
    frame.colorTexture = picture.color();
    frame.width = kWidth;
    frame.height = kHeight;
    const double eye[3] = {0.0, 1.5, 6.0}, target[3] = {0.0, 1.5, 0.0};
    check(fxSetFrameCamera(context, eye, target, 0.93f, 0.1f, &frame));
    return frame;
}

/// Replaces the file in one step, so that no reader sees half a picture.
void show(const example::Picture& picture, const std::string& output)
{
    picture.writePng(output + ".part");
    std::filesystem::rename(output + ".part", output);
}

void run(const Options& options)
{
    const example::OffscreenGl gl;
    example::Picture picture(kWidth, kHeight);
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.gl.getProcAddress = example::findOffscreenFunction;
    FxContext* context = nullptr;
    check(fxCreateContext(&contextDef, &context));
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    FxScene* scene = nullptr;
    check(fxCreateScene(context, &sceneDef, &scene));
    FxInstanceDef instance = fxDefaultInstanceDef();
    check(fxLoadPresetFile(context, options.preset.c_str(), &instance.preset));
    FxInstanceId id;
    check(fxScene_CreateInstance(scene, &instance, &id));
    const FxViewSettings settings = dusk();
    FxView* view = nullptr;
    check(fxCreateView(context, scene, &settings, &view));
    FxLiveLink* link = nullptr;                                // link
    FxLiveLinkDef linkDef = fxDefaultLiveLinkDef();            // link
    linkDef.name = options.link.c_str();                       // link
    if (!options.link.empty())                                 // link
        checkLink(fxCreateLiveLink(context, &linkDef, &link)); // link
    const FxFrameDef frame = camera(context, picture);
    auto next = std::chrono::steady_clock::now();
    for (long i = 0; options.frames == 0 || i < options.frames; ++i) {
        if (link)                                          // link
            checkLink(fxLiveLink_Update(link, &scene, 1)); // link
        check(fxScene_Update(scene, kStep));
        picture.clear(kDusk);
        check(fxView_Render(view, &frame));
        show(picture, options.output);
        next += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
            std::chrono::duration<double>(kStep));
        next = std::max(next, std::chrono::steady_clock::now()); // a slow frame is not made up for
        std::this_thread::sleep_until(next);
    }
    fxDestroyLiveLink(link); // link
    check(fxDestroyContext(context));
}

} // namespace

int main(int argumentCount, char** arguments)
{
    try {
        run(readOptions(std::vector<std::string>(arguments + 1, arguments + argumentCount)));
    } catch (const std::invalid_argument& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "05_live_picture: %s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
