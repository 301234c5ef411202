#include "fxsdk/editor/document/autosave.h"

#include "foundation/math/hash.h"
#include "fxsdk/assets/read_file.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/scene_file/scene_file.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace fx::editor {

namespace {

/// The text in a recovery file.
std::optional<std::string> readKept(const std::filesystem::path& file)
{
    const auto bytes = asset::readFile(file.string(), 2 * scene_file::kSceneBytes);
    if (!bytes)
        return std::nullopt;
    const Json kept = Json::parse(*bytes, nullptr, false);
    if (!kept.is_object() || !kept.contains("text") || !kept["text"].is_string())
        return std::nullopt;
    return kept["text"].get<std::string>();
}

} // namespace

std::filesystem::path recoveryFolder()
{
    if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state == '/')
        return std::filesystem::path(state) / "fxsdk" / "recovery";
    if (const char* home = std::getenv("HOME"); home && *home == '/')
        return std::filesystem::path(home) / ".local" / "state" / "fxsdk" / "recovery";
    return std::filesystem::temp_directory_path() / "fxsdk-recovery";
}

Autosave::Autosave(const std::string& path, std::filesystem::path folder)
{
    std::error_code ignored;
    path_ = path.empty() ? std::string("unnamed") : std::filesystem::absolute(path, ignored).string();
    char name[32];
    std::snprintf(name, sizeof name, "%016llx",
                  static_cast<unsigned long long>(base::hashBytes(0, path_.data(), path_.size())));
    file_ = std::move(folder) / (std::string(name) + ".json");
}

std::filesystem::path Autosave::lockFile() const
{
    return std::filesystem::path(file_).replace_extension(".lock");
}

std::optional<std::string> Autosave::recoverable() const
{
    return isOpenElsewhere() ? std::nullopt : readKept(file_);
}

bool Autosave::isOpenElsewhere() const
{
    std::error_code ignored;
    return !lock_.isHeld() && std::filesystem::exists(lockFile(), ignored) && !FileLock().take(lockFile());
}

base::Status Autosave::update(const Document& document, std::chrono::milliseconds interval)
{
    if (document.revision() == revision_ && document.isDirty() == isWritten_)
        return {};
    if (!document.isDirty()) {
        if (isWritten_)
            discard();
        revision_ = document.revision();
        return {};
    }
    const auto now = std::chrono::steady_clock::now();
    if (isWritten_ && now - written_ < interval)
        return {};
    std::error_code error;
    std::filesystem::create_directories(file_.parent_path(), error);
    if (!lock_.take(lockFile()))
        return {base::Code::Io,
                path_ + ": edits are not kept for a crash: another editor has unsaved ones of it, or " +
                    lockFile().string() + " cannot be written"};
    const Json kept{{"path", path_}, {"text", document.text()}};
    const std::string bytes = kept.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (base::Status status = cli::writeFileAtomically(file_, bytes); !status)
        return status;
    revision_ = document.revision();
    isWritten_ = true;
    written_ = now;
    return {};
}

void Autosave::discard()
{
    if (isOpenElsewhere())
        return; // the file is the other's
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
    std::filesystem::remove(lockFile(), ignored);
    lock_.release();
    isWritten_ = false;
}

} // namespace fx::editor
