#include "fxsdk/cli/support/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace fx::cli {

std::filesystem::path temporaryNameFor(const std::filesystem::path& target)
{
    std::string name(1, '.');
    name.append(target.stem().string()).append(".tmp").append(std::to_string(getpid()));
    return target.parent_path() / name.append(target.extension().string());
}

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {}

AtomicFile::~AtomicFile()
{
    if (descriptor_ >= 0)
        close(descriptor_);
    if (!temporary_.empty())
        unlink(temporary_.c_str());
}

base::Status AtomicFile::failed(const char* what) const
{
    return {base::Code::Io,
            "cannot " + std::string(what) + " " + target_.string() + ": " + std::strerror(errno)};
}

base::Status AtomicFile::open()
{
    struct stat info = {};
    const bool direct = stat(target_.c_str(), &info) == 0 && !S_ISREG(info.st_mode);
    if (!direct)
        temporary_ = temporaryNameFor(target_);
    const std::filesystem::path& name = direct ? target_ : temporary_;
    if (!direct)
        entered_ = EndsWithProgram(name.string());
    const int flags = O_WRONLY | O_CLOEXEC | (direct ? 0 : O_CREAT | O_TRUNC);
    descriptor_ = ::open(name.c_str(), flags, 0666);
    if (descriptor_ >= 0)
        return {};
    temporary_.clear();
    entered_ = {};
    return failed("create");
}

base::Status AtomicFile::write(std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            return failed("write");
        bytes.remove_prefix(size_t(written));
    }
    return {};
}

base::Status AtomicFile::commit(bool durable)
{
    // A full disk may show itself only here: on flushing, or on closing (network file systems).
    if (durable && !temporary_.empty() && fsync(descriptor_) != 0)
        return failed("write");
    if (close(std::exchange(descriptor_, -1)) != 0)
        return failed("write");
    if (temporary_.empty())
        return {};
    if (rename(temporary_.c_str(), target_.c_str()) != 0)
        return failed("create");
    temporary_.clear();
    entered_ = {};
    return {};
}

base::Status checkTarget(const std::filesystem::path& target)
{
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    std::error_code error;
    if (std::filesystem::is_directory(target, error))
        return {base::Code::Io, "cannot create " + target.string() + ": it is a folder"};
    if (std::filesystem::is_directory(folder, error))
        return {};
    return {base::Code::Io, "cannot create " + target.string() + ": there is no folder " + folder.string()};
}

base::Status writeFileAtomically(const std::filesystem::path& target, std::string_view bytes)
{
    AtomicFile file(target);
    base::Status status = file.open();
    if (status.ok())
        status = file.write(bytes);
    if (status.ok())
        status = file.commit();
    return status;
}

} // namespace fx::cli
