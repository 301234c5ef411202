#include "fxsdk/scene_file/stages.h"

#include "embedded/stage_files.h"
#include "fxsdk/presets/preset_loader.h"

#include <algorithm>
#include <array>
#include <vector>

namespace fx::scene_file {

namespace {

// The light of each stage is that of a place and an hour, in absolute units. The background of the gray
// studio is what its floor reflects: 0.18 (1500 lx * 0.799 / pi + 250 cd/m2).
constexpr auto kStages = std::to_array<Stage>({
    {"ground", "flat open country in afternoon light", R"({
  "exposureEv100": 13,
  "lighting": {"sunDirection": [0.55, 0.5, 0.45], "sunIlluminance": [40000, 34500, 27000], "skyLuminance": [2500, 3150, 4200]},
  "background": {"color": [1600, 2600, 4600], "horizon": [5200, 5700, 6100]}
})"},
    {"courtyard", "a paved courtyard between stone walls, late in the afternoon", R"({
  "exposureEv100": 11.8,
  "lighting": {"sunDirection": [0.62, 0.5, 0.6], "sunIlluminance": [14000, 10600, 7000], "skyLuminance": [620, 800, 1120], "groundAlbedo": 0.2},
  "background": {"color": [520, 760, 1350], "horizon": [2300, 1950, 1600]},
  "mesh": {"file": "library:stage-courtyard.obj"}
})"},
    {"night", "flat open country under the moon", R"({
  "exposureEv100": 7.3,
  "lighting": {"sunDirection": [-0.6, 0.55, -0.35], "sunIlluminance": [5, 5.8, 7.4], "skyLuminance": [0.9, 1.1, 1.7]},
  "background": {"color": [0.9, 1.3, 2.8], "horizon": [3.4, 3.9, 5.2]}
})"},
    {"wall", "a brick wall behind the effect, at dusk", R"({
  "exposureEv100": 8.8,
  "lighting": {"sunDirection": [-0.5, 0.5, 0.7], "sunIlluminance": [130, 120, 115], "skyLuminance": [62, 72, 92]},
  "background": {"color": [45, 70, 150], "horizon": [230, 200, 200]},
  "mesh": {"file": "library:stage-wall.obj"}
})"},
    {"corridor", "a corridor of 4 m by 3 m with sun in its windows", R"({
  "camera": {"position": [-0.7, 1.6, 5.6], "target": [0.1, 1.2, 0], "fovYDegrees": 55},
  "exposureEv100": 9.1,
  "lighting": {"sunDirection": [0.78, 0.42, 0.3], "sunIlluminance": [9000, 7600, 5900], "skyLuminance": [115, 120, 128], "groundAlbedo": 0.02},
  "background": {"color": [800, 1200, 2100], "horizon": [2000, 2100, 2200]},
  "mesh": {"file": "library:stage-corridor.obj"}
})"},
    {"water", "a stone quay in a lake, in the evening", R"({
  "exposureEv100": 11,
  "lighting": {"sunDirection": [-0.45, 0.22, -0.85], "sunIlluminance": [9000, 6100, 3600], "skyLuminance": [480, 560, 760], "groundAlbedo": 0.04},
  "background": {"color": [330, 520, 1000], "horizon": [2100, 1500, 1050]},
  "mesh": {"file": "library:stage-water.obj"}
})"},
    {"studio-gray", "a gray floor without a horizon, under a lamp and a bright ceiling", R"({
  "exposureEv100": 9.3,
  "lighting": {"sunDirection": [0.4, 0.8, 0.45], "sunIlluminance": [1500, 1500, 1500], "skyLuminance": [250, 250, 250], "groundAlbedo": 0.18},
  "background": {"color": [113.7, 113.7, 113.7]},
  "mesh": {"file": "library:stage-studio-gray.obj"}
})"},
});

} // namespace

std::span<const Stage> stages()
{
    return kStages;
}

std::span<const base::EmbeddedText> libraryWithStages()
{
    static const std::vector<base::EmbeddedText> files = [] {
        const auto library = preset::libraryFiles(), added = stage_files::texts();
        std::vector<base::EmbeddedText> all(library.begin(), library.end());
        all.insert(all.end(), added.begin(), added.end());
        return all;
    }();
    return files;
}

const Stage* findStage(std::string_view name)
{
    const auto found =
        std::find_if(kStages.begin(), kStages.end(), [&](const Stage& s) { return s.name == name; });
    return found == kStages.end() ? nullptr : &*found;
}

void setStage(nlohmann::ordered_json& io, std::string_view name)
{
    const Stage* const stage = findStage(name);
    if (!stage || !io.is_object())
        return;
    for (const char* member : {"mesh", "lighting", "background", "exposureEv100"})
        io.erase(member);
    const auto members = nlohmann::ordered_json::parse(stage->members);
    for (const auto& [member, value] : members.items())
        io[member] = value;
}

std::string presetOnStage(const std::string& text, std::string_view name)
{
    nlohmann::ordered_json preset = nlohmann::ordered_json::parse(text, nullptr, false);
    if (!preset.is_object())
        return text;
    nlohmann::ordered_json preview = preset.value("preview", nlohmann::ordered_json::object());
    if (!preview.is_object())
        return text;
    setStage(preview, name);
    preset["preview"] = std::move(preview);
    return preset.dump();
}

} // namespace fx::scene_file
