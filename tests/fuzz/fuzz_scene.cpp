// Scenes (*.scene.json) with the presets, meshes and pictures that they name.
#include "fxsdk/assets/read_file.h"
#include "fxsdk/scene_file/scene_file.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/presets/small_png.h"

#include <algorithm>
#include <filesystem>

namespace fx::fuzz {

namespace {

/// A file beside the scene, by the end of its name.
std::string besideScene(std::string_view name)
{
    if (name.ends_with(".obj"))
        return "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";
    if (name.ends_with(".png"))
        return test::smallPng();
    if (name.ends_with(".fx.json"))
        return R"({"version": 1, "emitters": [{"emission": {"rate": 10}, "lifetime": 1, "radius": 0.1,
                  "events": [{"on": "host", "name": "burst", "emit": 0, "count": 3}]}]})";
    return {};
}

int readBeside(void*, const char* name, uint64_t maxBytes, void (*deliver)(void*, const void*, size_t),
               void* sink)
{
    const std::string file = besideScene(name);
    if (file.empty())
        return 1;
    if (file.size() > maxBytes)
        return 2;
    deliver(sink, file.data(), file.size());
    return 0;
}

} // namespace

void runInput(std::span<const uint8_t> input)
{
    const asset::AssetResolver resolver("", preset::libraryFiles(), {nullptr, &readBeside});
    std::vector<preset::Diagnostic> diagnostics;
    const auto scene = scene_file::loadSceneText(textOf(input), "input", resolver, &diagnostics);
    require(scene.ok() != preset::hasErrors(diagnostics), "a scene is refused exactly when it has errors");
    for (const preset::Diagnostic& diagnostic : diagnostics)
        require(!diagnostic.message.empty() && diagnostic.message.size() <= 1024,
                "messages have 1 to 1024 bytes");
    if (!scene)
        return;
    for (const scene_file::SceneInstance& instance : scene->instances) {
        require(instance.preset < scene->presets.size(), "an instance has a preset");
        static_cast<void>(instance.placementAt(instance.start + 0.5));
    }
}

std::vector<std::string> seeds()
{
    std::vector<std::string> all{
        R"({"version": 1, "camera": {"position": [0, 1, 5], "target": [0, 1, 0]}, "mesh": {"file": "stage.obj"},
            "background": {"image": "sky.png"}, "instances": [{"preset": "spark.fx.json", "position": [0, 0, 0]}]})",
        R"({"version": 1, "instances": [{"preset": "library:sparks", "start": 0.5}, {"preset": "none.fx.json"}]})",
        "{\"version\": 1",
    };
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(FX_SOURCE_DIR "/examples/scenes"))
        if (entry.path().string().ends_with(".scene.json"))
            paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    for (const std::filesystem::path& path : paths) {
        const auto text = asset::readFile(path.string(), scene_file::kSceneBytes);
        require(text.ok(), "the scenes of the examples can be read", path.string());
        all.push_back(*text);
    }
    return all;
}

} // namespace fx::fuzz
