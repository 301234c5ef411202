#include "benchmarks/accuracy/techniques/cumulus_scenes.h"

#include "benchmarks/scenes/chance.h"
#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/presets/preset_loader.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace fx::cli {
namespace {

constexpr const char* kName = "library:cumulus";

base::Result<nlohmann::json> cumulusPreset()
{
    const auto text = asset::AssetResolver("", preset::libraryFiles()).read(kName, preset::kPresetBytes);
    if (!text.ok())
        return text.status();
    auto preset = nlohmann::json::parse(*text);
    preset["scattering"] = "closed_form"; // the light of a network follows with a delay of frames
    return preset;
}

base::Result<scene_file::SceneFile> sceneOf(const nlohmann::json& preset)
{
    auto scene = sceneOfPresetText(preset.dump(), kName);
    if (!scene.ok())
        return scene.status();
    scene->view.composition = render::Composition::Slabs;
    scene->view.slabs = 16;
    scene->view.dazzle.enabled = false; // spreads the change of a pixel over others
    scene->view.shimmer.strength = 0.0f;
    return scene;
}

} // namespace

base::Result<scene_file::SceneFile> cumulusScene(const Cumulus& cumulus)
{
    auto preset = cumulusPreset();
    if (!preset.ok())
        return preset.status();
    if (cumulus.isSmall) {
        nlohmann::json& form = (*preset)["blocks"][0]["builder"];
        form["size"] = {26, 16, 20};
        form["count"] = 60;
        form["towers"] = 4;
        form["noiseLength"] = 7;
    }
    return sceneOf(*preset);
}

base::Result<scene_file::SceneFile> twinBlocksScene(uint32_t pairs, uint64_t seed, bool isReversed)
{
    auto preset = cumulusPreset();
    if (!preset.ok())
        return preset.status();
    nlohmann::json& element = (*preset)["blocks"][0];
    nlohmann::json white = element["types"][0], brown = white;
    white["name"] = "white";
    brown["name"] = "brown";
    brown["builder"]["albedo"] = {0.9, 0.5, 0.2};
    element["types"] = {white, brown};
    element.erase("builder");
    bench::Chance chance(seed);
    std::vector<nlohmann::json> blocks;
    for (uint32_t pair = 0; pair < pairs; ++pair) {
        const glm::dvec3 place = glm::dvec3(9.0, 5.0, 7.0) * chance.inCube() + glm::dvec3(0.0, 27.0, 0.0);
        const double turn = chance.between(0.0, 360.0), scale = chance.between(0.5, 1.0);
        for (const char* type : {"white", "brown"})
            blocks.push_back({{"type", type},
                              {"position", {place.x, place.y, place.z}},
                              {"angleDegrees", turn},
                              {"scale", scale}});
    }
    if (isReversed)
        std::ranges::reverse(blocks);
    element["blocks"] = blocks;
    return sceneOf(*preset);
}

} // namespace fx::cli
