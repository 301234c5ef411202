#include "fxsdk/scene_file/validate_file.h"

#include "fxsdk/assets/read_file.h"
#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/scene_file/preview.h"
#include "fxsdk/scene_file/scene_file.h"

namespace fx::preset {

namespace {

/// What an instance needs, nothing of a preset that cannot be loaded.
Needs validatePreset(const std::string& path, std::vector<Diagnostic>& diagnostics)
{
    const auto loaded = loadPresetFile(path, &diagnostics);
    if (!loaded)
        return {};
    const Needs needs{loaded->effect->bytes(), loaded->effect->cost};
    const base::Result<std::string> text = asset::readFile(path, kPresetBytes);
    if (!text)
        return needs; // it was there a moment ago
    const std::string folder = folderOf(path);
    const asset::AssetResolver resolver(folder.empty() ? "." : folder, libraryFiles());
    scene_file::SceneFile scene;
    scene.presets.push_back({path, *text, path, loaded->effect});
    scene.instances.emplace_back();
    static_cast<void>(scene_file::readPreview(*text, path, resolver, scene, &diagnostics));
    return needs;
}

} // namespace

std::vector<Diagnostic> validateFile(const std::string& path, Needs* outNeeds)
{
    std::vector<Diagnostic> diagnostics;
    Needs needs;
    if (path.ends_with(".scene.json"))
        static_cast<void>(scene_file::loadSceneFile(path, &diagnostics));
    else if (path.ends_with(".fx.json"))
        needs = validatePreset(path, diagnostics);
    else
        diagnostics.push_back(
            {path, 0, 0, "", "not a name that is known here: presets end in .fx.json, scenes in .scene.json",
             false});
    if (outNeeds)
        *outNeeds = needs;
    return diagnostics;
}

} // namespace fx::preset
