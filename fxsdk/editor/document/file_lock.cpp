#include "fxsdk/editor/document/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

namespace fx::editor {

FileLock::~FileLock()
{
    release();
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept
{
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

bool FileLock::take(const std::filesystem::path& file)
{
    if (isHeld())
        return true;
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor >= 0 && flock(descriptor, LOCK_EX | LOCK_NB) == 0)
        descriptor_ = descriptor;
    else if (descriptor >= 0)
        close(descriptor);
    return isHeld();
}

void FileLock::release()
{
    if (isHeld())
        close(std::exchange(descriptor_, -1));
}

} // namespace fx::editor
