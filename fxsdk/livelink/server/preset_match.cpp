#include "fxsdk/livelink/server/preset_match.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace fx::link {

namespace {

constexpr size_t kListed = 20; ///< names in a message

bool isSource(std::string_view wanted, const NamedPreset& preset)
{
    return preset.source == wanted;
}

/// Whether `path` ends with the whole names of `part`.
bool endsWithPath(std::string_view path, std::string_view part)
{
    return part.size() < path.size() && path.ends_with(part) && path[path.size() - part.size() - 1] == '/';
}

bool isSameFile(std::string_view wanted, const NamedPreset& preset)
{
    std::string_view source = preset.source;
    for (std::string_view* path : {&wanted, &source})
        while (path->starts_with("./"))
            path->remove_prefix(2);
    return !source.empty() &&
           (wanted == source || endsWithPath(wanted, source) || endsWithPath(source, wanted));
}

std::string_view fileNameOf(std::string_view path)
{
    return path.substr(path.find_last_of('/') + 1);
}

bool hasFileName(std::string_view wanted, const NamedPreset& preset)
{
    return !preset.source.empty() && fileNameOf(wanted) == fileNameOf(preset.source);
}

bool hasName(std::string_view wanted, const NamedPreset& preset)
{
    return preset.name == wanted;
}

std::string listOf(const std::vector<NamedPreset>& presets)
{
    std::string list;
    for (size_t i = 0; i < std::min(presets.size(), kListed); ++i)
        list += (i == 0 ? "" : ", ") + presets[i].source;
    return presets.size() > kListed ? list + ", ..." : list;
}

} // namespace

base::Result<std::vector<size_t>> matchPreset(const std::string& wanted,
                                              const std::vector<NamedPreset>& presets)
{
    using Rule = bool (*)(std::string_view, const NamedPreset&);
    for (const Rule fits : std::array<Rule, 4>{&isSource, &isSameFile, &hasFileName, &hasName}) {
        std::vector<size_t> found;
        std::vector<NamedPreset> candidates;
        bool isOneSource = true;
        for (size_t i = 0; i < presets.size(); ++i) {
            if (!fits(wanted, presets[i]))
                continue;
            isOneSource = isOneSource && (found.empty() || presets[i].source == candidates.front().source);
            found.push_back(i);
            candidates.push_back(presets[i]);
        }
        if (!isOneSource)
            return base::Status(base::Code::Capacity, "\"" + wanted +
                                                          "\" fits several presets of the game (" +
                                                          listOf(candidates) + "); state one of them");
        if (!found.empty())
            return found;
    }
    return base::Status(base::Code::NotFound, "the game has no preset \"" + wanted + "\"; it has: " +
                                                  (presets.empty() ? "none" : listOf(presets)));
}

} // namespace fx::link
