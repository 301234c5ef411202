/// @file scratch_file.h
/// A file in memory with a path, for readers that require a path.
#pragma once

#include "tests/fuzz/fuzz_target.h"

#include <sys/mman.h>
#include <unistd.h>

namespace fx::fuzz {

class ScratchFile
{
public:
    explicit ScratchFile(std::span<const uint8_t> content) : descriptor_(memfd_create("fuzz", MFD_CLOEXEC))
    {
        require(descriptor_ >= 0, "the system gives a file in memory");
        size_t done = 0;
        while (done < content.size()) {
            const ssize_t written = write(descriptor_, content.data() + done, content.size() - done);
            require(written > 0, "the file in memory can be written");
            done += size_t(written);
        }
    }
    ~ScratchFile() { close(descriptor_); }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    /// Path under which the file can be opened any number of times.
    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
    int descriptor_;
};

} // namespace fx::fuzz
