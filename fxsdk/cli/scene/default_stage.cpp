#include "fxsdk/cli/scene/default_stage.h"

#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/assets/read_file.h"
#include "fxsdk/cli/scene/effect_framing.h"
#include "fxsdk/presets/preset_loader.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::cli {
namespace {

constexpr int kTiles = 24;           // a side
constexpr float kTileSize = 2.5f;    // [m]
constexpr int kFramingMoments = 12;  // looked at between the start and the end
constexpr double kFramingLimit = 20; // [s] longest time simulated only to place the camera

void addTile(render::StageMesh& mesh, int i, int j)
{
    const float x0 = float(i - kTiles / 2) * kTileSize;
    const float z0 = float(j - kTiles / 2) * kTileSize;
    const float x1 = x0 + kTileSize;
    const float z1 = z0 + kTileSize;
    const glm::vec3 color =
        (i + j) % 2 == 0 ? glm::vec3(0.24f, 0.225f, 0.20f) : glm::vec3(0.20f, 0.19f, 0.17f);
    for (const glm::vec3& corner : {glm::vec3(x0, 0, z1), glm::vec3(x1, 0, z1), glm::vec3(x1, 0, z0),
                                    glm::vec3(x0, 0, z1), glm::vec3(x1, 0, z0), glm::vec3(x0, 0, z0)})
    {
        mesh.positions.push_back(corner);
        mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        mesh.colors.push_back(color);
    }
}

/// A checkered ground and late afternoon light.
void addDefaultStage(scene_file::SceneFile& scene)
{
    for (int i = 0; i < kTiles; ++i) {
        for (int j = 0; j < kTiles; ++j)
            addTile(scene.mesh, i, j);
    }
    scene.background.luminance = {1500.0f, 1900.0f, 2500.0f};
    scene.background.horizon = {2600.0f, 2700.0f, 2700.0f};
    scene.view.lighting.sunDirection = glm::normalize(glm::vec3(0.55f, 0.5f, 0.45f));
    scene.view.lighting.sunIlluminance = {24000.0f, 20500.0f, 16000.0f};
    scene.view.lighting.skyLuminance = {1500.0f, 1900.0f, 2500.0f};
    scene.view.exposureEv100 = 13.0f;
}

} // namespace

base::Result<scene_file::SceneFile> sceneOfPreset(const std::string& input, scene_file::Preview* outPreview)
{
    const bool fromLibrary = input.rfind("library:", 0) == 0;
    auto text = fromLibrary
                    ? asset::AssetResolver("", preset::libraryFiles()).read(input, preset::kPresetBytes)
                    : asset::readFile(input, preset::kPresetBytes);
    if (!text.ok())
        return text.status();
    auto loaded = fromLibrary ? preset::loadPresetText(*text, input) : preset::loadPresetFile(input);
    if (!loaded.ok())
        return loaded.status();
    scene_file::SceneFile scene;
    scene.name = input;
    scene.warnings = loaded->warnings;
    scene.presets.push_back({input, *text, fromLibrary ? std::string() : input, loaded->effect});
    scene.instances.emplace_back();
    addDefaultStage(scene);
    const std::string folder = fromLibrary ? std::string() : preset::folderOf(input);
    const asset::AssetResolver resolver(folder.empty() && !fromLibrary ? "." : folder,
                                        preset::libraryFiles());
    const auto preview = scene_file::readPreview(*text, input, resolver, scene, &scene.warnings);
    if (!preview.ok())
        return preview.status();
    if (outPreview)
        *outPreview = *preview;
    return scene;
}

base::Status frameEffect(scene_file::SceneFile& scene, base::Ticks until, const EffectSceneOptions& options,
                         double aspect)
{
    auto effects = EffectScene::create(scene, options);
    if (!effects.ok())
        return effects.status();
    const base::Ticks end = std::min(until, base::toTicks(kFramingLimit));
    EffectFraming framing;
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
    if (!framing.isEmpty())
        framing.place(scene.camera, aspect);
    return {};
}

} // namespace fx::cli
