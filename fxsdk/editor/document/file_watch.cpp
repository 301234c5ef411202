#include "fxsdk/editor/document/file_watch.h"

#include "fxsdk/assets/read_file.h"
#include "fxsdk/scene_file/scene_file.h"

#include <sys/stat.h>
#include <utility>

namespace fx::editor {

FileWatch::FileWatch(std::filesystem::path path, std::chrono::milliseconds interval)
    : path_(std::move(path)), interval_(interval), looked_(std::chrono::steady_clock::now() - interval),
      stamp_(stampNow())
{}

FileWatch::Stamp FileWatch::stampNow() const
{
    struct stat state = {};
    if (path_.empty() || stat(path_.c_str(), &state) != 0)
        return {};
    return {state.st_mtim.tv_sec, state.st_mtim.tv_nsec, state.st_ino, uint64_t(state.st_size)};
}

std::optional<std::string> FileWatch::changedText(const std::string& known)
{
    const auto now = std::chrono::steady_clock::now();
    if (now - looked_ < interval_)
        return std::nullopt;
    looked_ = now;
    const Stamp present = stampNow();
    if (present == stamp_)
        return std::nullopt;
    auto text = asset::readFile(path_.string(), scene_file::kSceneBytes);
    if (!text)
        return std::nullopt;
    stamp_ = present;
    if (*text == known)
        return std::nullopt;
    return std::move(*text);
}

} // namespace fx::editor
