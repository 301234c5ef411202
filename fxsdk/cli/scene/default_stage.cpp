#include "fxsdk/cli/scene/default_stage.h"

#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/assets/read_file.h"
#include "fxsdk/cli/scene/effect_framing.h"
#include "fxsdk/presets/preset_loader.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::cli {
namespace {

constexpr int kTiles = 48;          // a side
constexpr float kTileSize = 2.5f;   // [m]
constexpr float kClear = 20.0f;     // [m] from the middle, up to where tiles differ fully
constexpr float kHorizon = 2000.0f; // [m] half of the ground's side
constexpr glm::vec3 kGround(0.22f, 0.2075f, 0.185f);
constexpr glm::vec3 kTileContrast(0.02f, 0.0175f, 0.015f);
constexpr int kFramingMoments = 12;  // looked at between the start and the end
constexpr double kFramingLimit = 20; // [s] longest time simulated only to place the camera

void addRectangle(render::StageMesh& mesh, const glm::vec2& low, const glm::vec2& high,
                  const glm::vec3& color)
{
    const glm::vec3 corners[] = {
        {low.x, 0, high.y}, {high.x, 0, high.y}, {high.x, 0, low.y}, {low.x, 0, low.y}};
    for (const size_t i : {0, 1, 2, 0, 2, 3}) {
        mesh.positions.push_back(corners[i]);
        mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        mesh.colors.push_back(color);
    }
}

/// Tiles give a scale; away from the middle they fade into the ground, which reaches to the horizon.
void addGround(render::StageMesh& mesh)
{
    constexpr float kSide = 0.5f * float(kTiles) * kTileSize;
    for (int i = 0; i < kTiles; ++i)
        for (int j = 0; j < kTiles; ++j) {
            const glm::vec2 low = glm::vec2(i, j) * kTileSize - kSide;
            const float away = glm::length(low + 0.5f * kTileSize);
            const float share = std::clamp((kSide - away) / (kSide - kClear), 0.0f, 1.0f);
            const float sign = (i + j) % 2 == 0 ? 1.0f : -1.0f;
            addRectangle(mesh, low, low + kTileSize, kGround + sign * share * kTileContrast);
        }
    addRectangle(mesh, {-kHorizon, -kHorizon}, {kHorizon, -kSide}, kGround);
    addRectangle(mesh, {-kHorizon, kSide}, {kHorizon, kHorizon}, kGround);
    addRectangle(mesh, {-kHorizon, -kSide}, {-kSide, kSide}, kGround);
    addRectangle(mesh, {kSide, -kSide}, {kHorizon, kSide}, kGround);
}

/// Ground and late afternoon light.
void addDefaultStage(scene_file::SceneFile& scene)
{
    addGround(scene.mesh);
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
