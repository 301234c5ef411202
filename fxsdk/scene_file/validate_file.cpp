#include "fxsdk/scene_file/validate_file.h"

#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/scene_file/scene_file.h"

namespace fx::preset {

std::vector<Diagnostic> validateFile(const std::string& path)
{
    std::vector<Diagnostic> diagnostics;
    if (path.ends_with(".scene.json"))
        static_cast<void>(scene_file::loadSceneFile(path, &diagnostics));
    else if (path.ends_with(".fx.json"))
        static_cast<void>(loadPresetFile(path, &diagnostics));
    else
        diagnostics.push_back(
            {path, 0, 0, "", "not a name that is known here: presets end in .fx.json, scenes in .scene.json",
             false});
    return diagnostics;
}

} // namespace fx::preset
