#include "fxsdk/cli/import/preset_files.h"

#include "fxsdk/cli/support/atomic_file.h"
#include "rendering/optics/black_body.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace fx::cli {
namespace {

constexpr glm::vec3 kLuminance{0.2126f, 0.7152f,
                               0.0722f}; // of linear Rec. 709, as rendering/optics/black_body.h
constexpr std::string_view kPresetSuffix = ".fx.json";

} // namespace

base::Result<std::string> presetStem(const std::filesystem::path& preset)
{
    std::string stem = preset.filename().string();
    if (!stem.ends_with(kPresetSuffix) || stem.size() == kPresetSuffix.size())
        return base::Status(base::Code::InvalidArgument,
                            preset.string() + ": the name of a preset ends in .fx.json");
    stem.resize(stem.size() - kPresetSuffix.size());
    return stem;
}

glm::vec3 colorOf(double temperature)
{
    const glm::vec3 light = render::blackBodyLuminance(float(temperature));
    const float luminance = glm::dot(light, kLuminance);
    return luminance > 0.0f ? light / luminance : glm::vec3(1.0f);
}

base::Status writePresetFiles(const std::filesystem::path& preset, const nlohmann::ordered_json& text,
                              const std::filesystem::path& file, std::string_view bytes)
{
    if (base::Status status = writeFileAtomically(file, bytes); !status)
        return status;
    return writeFileAtomically(preset,
                               text.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

} // namespace fx::cli
