#include "fxsdk/cli/scene/default_stage.h"

#include "foundation/snapshot/blob_kind.h"
#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/assets/read_file.h"
#include "fxsdk/presets/preset_loader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::cli {
namespace {

constexpr int kTiles = 24;          // a side
constexpr float kTileSize = 2.5f;   // [m]
constexpr int kFramingMoments = 12; // looked at between the start and the end
constexpr double kFramingLimit = 8; // [s] longest time simulated only to place the camera

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

/// Mean and spread of the medium, weighted by extinction cross section, over the moments that were added.
class Extent
{
public:
    void add(const base::FrameSnapshot& snapshot)
    {
        for (size_t g = 0; g < snapshot.groupCount(); ++g)
            if (snapshot.group(g).info().kind == snapshot.schema().find(base::kBlobKind.name))
                add(snapshot.group(g));
    }
    void add(const std::vector<glm::vec4>& places)
    {
        for (const glm::vec4& place : places)
            add(glm::dvec3(place), double(place.w), std::numbers::pi * double(place.w) * double(place.w));
    }
    bool empty() const { return !(weight_ > 0.0); }
    glm::dvec3 center() const { return sum_ / weight_; }
    /// [m] of a ball that holds most of it
    double radius() const
    {
        const double variance = square_ / weight_ - glm::dot(center(), center());
        return 1.8 * std::sqrt(std::max(variance, 1e-4));
    }

private:
    void add(const base::SnapshotGroup& group)
    {
        namespace column = base::blob_column;
        const base::Placement& placement = group.info().placement;
        for (size_t i = 0; i < group.count(); ++i) {
            const glm::vec3 local(group.column(column::PositionX)[i], group.column(column::PositionY)[i],
                                  group.column(column::PositionZ)[i]);
            const double radius = double(group.column(column::Radius)[i] * placement.scale);
            const double weight = double(group.column(column::CrossSection)[i]);
            const glm::dvec3 world =
                placement.position + glm::dvec3(placement.rotation * (placement.scale * local));
            add(world, radius, weight);
        }
    }
    void add(const glm::dvec3& world, double radius, double weight)
    {
        if (!std::isfinite(weight * (glm::dot(world, world) + radius)))
            return;
        weight_ += weight;
        sum_ += weight * world;
        square_ += weight * (glm::dot(world, world) + 0.5 * radius * radius);
    }

    double weight_ = 0.0;
    double square_ = 0.0;
    glm::dvec3 sum_{0.0};
};

void lookAt(scene_file::CameraPath& camera, const Extent& extent)
{
    const double radius = std::clamp(extent.radius(), 0.3, 200.0);
    const double halfAngle = double(camera.fovYDegrees) * std::numbers::pi / 360.0;
    const double distance = 1.15 * radius / std::sin(halfAngle);
    camera.target = extent.center();
    camera.position = camera.target + distance * glm::normalize(glm::dvec3(0.25, 0.12, 1.0));
    camera.position.y = std::max(camera.position.y, 0.15 * radius); // above the ground
    camera.nearPlane = float(std::min(0.1, 0.01 * distance));
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

base::Status frameEffect(scene_file::SceneFile& scene, base::Ticks until, const EffectSceneOptions& options)
{
    auto effects = EffectScene::create(scene, options);
    if (!effects.ok())
        return effects.status();
    const base::Ticks end = std::min(until, base::toTicks(kFramingLimit));
    Extent extent;
    for (int i = 1; i <= kFramingMoments; ++i) {
        if (base::Status status = (*effects)->showMoment(end * i / kFramingMoments); !status)
            return status;
        const auto snapshot = (*effects)->snapshot();
        if (!snapshot.ok())
            return snapshot.status();
        extent.add(**snapshot);
        const auto places = (*effects)->places();
        if (!places.ok())
            return places.status();
        extent.add(*places);
    }
    if (!extent.empty())
        lookAt(scene.camera, extent);
    return {};
}

} // namespace fx::cli
