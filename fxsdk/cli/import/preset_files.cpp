#include "fxsdk/cli/import/preset_files.h"

#include "fxsdk/cli/support/atomic_file.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace fx::cli {
namespace {

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

void setAnisotropy(double anisotropy, nlohmann::ordered_json& ioPreset)
{
    const double rounded = std::round(1e4 * anisotropy) / 1e4;
    for (const char* const media : {"volumes", "clouds"})
        if (rounded != 0.0 && ioPreset.contains(media))
            for (nlohmann::ordered_json& element : ioPreset[media])
                element["anisotropy"] = rounded;
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
