#include "fxsdk/editor/document/starter.h"

#include <filesystem>
#include <string_view>

namespace fx::editor {

namespace {

using base::Code;
using base::Status;

constexpr std::string_view kPresetExtension = ".fx.json", kSceneExtension = ".scene.json";

/// Smoke whose numbers are those of thin smoke of wood, so that every further edit is seen.
constexpr const char* kPreset = R"({
  "version": 1,
  "name": "",
  "emitters": [
    {
      "name": "smoke",
      "layer": "smoke",
      "maxParticles": 100,
      "shape": "cone",
      "size": 0.1,
      "angleDegrees": 10,
      "emission": {"rate": 20},
      "lifetime": {"min": 3, "max": 4},
      "speed": {"min": 0.6, "max": 1},
      "radius": {"min": 0.14, "max": 0.22},
      "opticalDepth": 2,
      "forces": {"gravity": 0, "drag": 0.5, "curlStrength": 0.4},
      "sizeOverLife": {"keys": [[0, 0.6], [1, 2.5]]},
      "opacityOverLife": {"keys": [[0, 0], [0.1, 1], [1, 0]]},
      "albedoOverLife": [0.9, 0.89, 0.87],
      "detailAmount": 1
    }
  ],
  "preview": {
    "time": 3,
    "camera": {"position": [0, 1.4, 6], "target": [0, 1.2, 0], "fovYDegrees": 40},
    "figure": {"position": [-1.4, 0, 0], "headingDegrees": 90}
  }
}
)";

constexpr const char* kScene = R"({
  "version": 1,
  "name": "",
  "camera": {"position": [1.2, 1.1, 4.2], "target": [0, 0.75, 0], "fovYDegrees": 42},
  "exposureEv100": 10,
  "lighting": {"sunDirection": [-0.62, 0.25, 0.5], "sunIlluminance": [260, 190, 130], "skyLuminance": [26, 34, 52]},
  "background": {"color": [24, 34, 60], "horizon": [110, 84, 64]},
  "instances": [{"preset": "library:campfire", "position": [0, 0, 0]}]
}
)";

Status refuse(Code code, const std::string& path, const char* why)
{
    return {code, path + ": " + why};
}

} // namespace

base::Result<Document> newDocument(const std::string& path)
{
    const std::filesystem::path file(path);
    std::string name = file.filename().string();
    const bool isScene = name.ends_with(kSceneExtension);
    const std::string_view extension = isScene ? kSceneExtension : kPresetExtension;
    if (!name.ends_with(extension) || name.size() == extension.size())
        return refuse(Code::InvalidArgument, path, "a new file is named NAME.fx.json or NAME.scene.json");
    std::error_code error;
    if (std::filesystem::exists(file, error))
        return refuse(Code::InvalidArgument, path, "the file exists; open it without --new");
    if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path(), error))
        return refuse(Code::NotFound, path, "no such folder; create it first");
    name.resize(name.size() - extension.size());
    const std::string empty = R"("name": "")";
    std::string text = isScene ? kScene : kPreset;
    text.replace(text.find(empty), empty.size(),
                 R"("name": )" + Json(name).dump(-1, ' ', false, Json::error_handler_t::replace));
    return Document::fromText(text, path);
}

} // namespace fx::editor
