#include "tests/api/library_names.h"

#include "fxsdk/presets/preset_loader.h"

#include <string_view>

namespace fx::test {

std::vector<std::string> libraryNames()
{
    constexpr std::string_view kSuffix = ".fx.json";
    std::vector<std::string> names;
    for (const auto& entry : preset::presetLibrary())
        if (FXSDK_WITH_SPH || entry.text.find("\"gas\"") == std::string_view::npos)
            names.emplace_back(entry.name.substr(0, entry.name.size() - kSuffix.size()));
    return names;
}

} // namespace fx::test
