#include "benchmarks/accuracy/techniques/cumulus_scenes.h"

#include "benchmarks/scenes/chance.h"
#include "fxsdk/cli/scene/default_stage.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace fx::cli {
namespace {

constexpr const char* kName = "library:cumulus of block-flights"; // named as one without a file

/// A heap cloud of 29,790 balls in 360 blocks. Light by the closed form: that of a network follows with a
/// delay of frames.
constexpr const char* kPreset = R"({
  "version": 1,
  "name": "cumulus",
  "composition": "slabs",
  "scattering": "closed_form",
  "ground": false,
  "blocks": [
    {
      "layer": "smoke",
      "density": 0.6,
      "anisotropy": 0.6,
      "detail": {"material": "steam", "billowSize": 5, "crispness": 0.35, "raggedness": 0.7, "softening": 1.5},
      "types": [
        {"name": "puff", "builder": {"form": "cloud", "seed": 3, "position": [0, -4, 0], "size": [10, 8, 10], "count": 90, "towers": 6, "radius": {"min": 0.8, "max": 2}, "noise": 0.25, "noiseLength": 3, "opticalDepth": 1.2, "albedo": [0.99, 0.99, 0.99]}},
        {"name": "wisp", "builder": {"form": "nebula", "seed": 5, "size": [10, 6, 10], "count": 60, "radius": {"min": 0.7, "max": 1.6}, "noise": 0.5, "noiseLength": 4, "opticalDepth": 0.5, "albedo": [0.99, 0.99, 0.99]}}
      ],
      "builder": {"form": "cloud", "of": [{"type": "puff"}, {"type": "puff"}, {"type": "puff"}, {"type": "wisp"}], "turn": "upright", "seed": 11, "position": [0, 20, 0], "size": [60, 36, 44], "count": 360, "towers": 9, "base": 0.08, "radius": {"min": 3, "max": 6}, "noise": 0.3, "noiseLength": 14}
    }
  ],
  "preview": {
    "camera": {"position": [0, 1.8, 95], "target": [0, 27, 0], "fovYDegrees": 45},
    "exposureEv100": 13.6,
    "lighting": {"sunDirection": [-0.75, 0.5, 0.35], "sunIlluminance": [66000, 61000, 53000], "skyLuminance": [2300, 3300, 5200]},
    "background": {"color": [1500, 2900, 6200], "horizon": [6200, 7400, 8800]}
  }
})";

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
    auto preset = nlohmann::json::parse(kPreset);
    if (cumulus.isSmall) {
        nlohmann::json& form = preset["blocks"][0]["builder"];
        form["size"] = {26, 16, 20};
        form["count"] = 60;
        form["towers"] = 4;
        form["noiseLength"] = 7;
    }
    return sceneOf(preset);
}

base::Result<scene_file::SceneFile> twinBlocksScene(uint32_t pairs, uint64_t seed, bool isReversed)
{
    auto preset = nlohmann::json::parse(kPreset);
    nlohmann::json& element = preset["blocks"][0];
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
    return sceneOf(preset);
}

} // namespace fx::cli
