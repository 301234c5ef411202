#include "fxsdk/scene_file/validate_file.h"

#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/scene_file/scene_file.h"

namespace fx::preset {

std::vector<Diagnostic> validateFile(const std::string& path, uint64_t* outBytes)
{
    std::vector<Diagnostic> diagnostics;
    uint64_t bytes = 0;
    if (path.ends_with(".scene.json"))
        static_cast<void>(scene_file::loadSceneFile(path, &diagnostics));
    else if (path.ends_with(".fx.json")) {
        if (const auto loaded = loadPresetFile(path, &diagnostics))
            bytes = loaded->effect->bytes();
    } else
        diagnostics.push_back(
            {path, 0, 0, "", "not a name that is known here: presets end in .fx.json, scenes in .scene.json",
             false});
    if (outBytes)
        *outBytes = bytes;
    return diagnostics;
}

} // namespace fx::preset
