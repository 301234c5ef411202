#include "fxsdk/cli/scene/default_stage.h"

#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/assets/read_file.h"
#include "fxsdk/cli/scene/preview_ground.h"
#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/scene/effect_framing.h"
#include "fxsdk/scene_file/stages.h"

#include <algorithm>
#include <numbers>

namespace fx::cli {
namespace {

constexpr int kFramingMoments = 12;     // looked at between the start and the end
constexpr double kMostHalfHeight = 200; // [m] of a picture, whatever the size of the effect
constexpr double kFramingLimit = 20;    // [s] longest time simulated only to place the camera

/// Ground and late afternoon light.
void addDefaultStage(scene_file::SceneFile& scene)
{
    addPreviewGround(scene.mesh);
    scene.background.luminance = {1600.0f, 2600.0f, 4600.0f};
    scene.background.horizon = {5200.0f, 5700.0f, 6100.0f};
    const sim::PreviewDef preview;
    scene.view.lighting = {preview.sunDirection, preview.sunIlluminance, preview.skyLuminance,
                           preview.groundAlbedo};
    scene.view.exposureEv100 = preview.exposureEv100;
}

} // namespace

base::Result<scene_file::SceneFile> sceneOfPreset(const std::string& input, scene_file::Preview* outPreview,
                                                  const std::string& stage)
{
    const bool fromLibrary = input.rfind("library:", 0) == 0;
    auto text = fromLibrary
                    ? asset::AssetResolver("", preset::libraryFiles()).read(input, preset::kPresetBytes)
                    : asset::readFile(input, preset::kPresetBytes);
    if (!text.ok())
        return text.status();
    return sceneOfPresetText(*text, input, outPreview, stage);
}

void followPresets(scene_file::SceneFile& io)
{
    io.view.composition = render::Composition::Automatic;
    io.view.slices.automatic = true;
}

base::Result<scene_file::SceneFile> sceneOfPresetText(const std::string& text, const std::string& input,
                                                      scene_file::Preview* outPreview,
                                                      const std::string& stage)
{
    const bool fromLibrary = input.rfind("library:", 0) == 0;
    const std::string folder = fromLibrary ? std::string() : preset::folderOf(input);
    const asset::AssetResolver resolver(folder.empty() && !fromLibrary ? "." : folder,
                                        preset::libraryFiles());
    auto loaded = preset::loadPresetText(text, input, nullptr, &resolver);
    if (!loaded.ok())
        return loaded.status();
    scene_file::SceneFile scene;
    scene.name = input;
    scene.warnings = loaded->warnings;
    scene.presets.push_back({input, text, fromLibrary ? std::string() : input, loaded->effect});
    scene.instances.emplace_back();
    addDefaultStage(scene);
    const auto preview =
        scene_file::readPreview(stage.empty() ? text : scene_file::presetOnStage(text, stage), input,
                                resolver, scene, &scene.warnings);
    if (!preview.ok())
        return preview.status();
    scene.background.hasHills =
        scene.mesh.isSoil || scene.mesh.waterVertices > 0; // a preview may have a mesh of its own
    if (outPreview)
        *outPreview = *preview;
    return scene;
}

base::Status frameEffect(scene_file::SceneFile& shown, base::Ticks until, const EffectSceneOptions& options,
                         double aspect)
{
    auto effects = EffectScene::create(shown, options);
    if (!effects.ok())
        return effects.status();
    const base::Ticks end = std::min(until, base::toTicks(kFramingLimit));
    scene::EffectFraming framing;
    for (int i = 1; i <= kFramingMoments; ++i) {
        if (base::Status status = (*effects)->showMoment(end * i / kFramingMoments); !status)
            return status;
        const auto snapshot = (*effects)->snapshot();
        if (!snapshot.ok())
            return snapshot.status();
        framing.nextMoment();
        framing.add(**snapshot);
        const auto places = (*effects)->places();
        if (!places.ok())
            return places.status();
        framing.add(*places);
    }
    if (framing.isEmpty())
        return {};
    const scene::EffectFraming::Camera camera = framing.place(
        double(shown.camera.fovYDegrees) * std::numbers::pi / 180.0, aspect, 0.0, kMostHalfHeight);
    shown.camera.position = camera.position;
    shown.camera.target = camera.target;
    shown.camera.nearPlane = camera.nearDistance;
    return {};
}

} // namespace fx::cli
