/// @file file_lock.h
/// A lock between programs that ends with the program that holds it, however it ends.
#pragma once

#include <filesystem>

namespace fx::editor {

/// Threads: one at a time.
class FileLock
{
public:
    FileLock() = default;
    ~FileLock();
    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&& other) noexcept;

    /// Creates the file if needed and locks it. @return false: another holder has it, or it cannot be created
    bool take(const std::filesystem::path& file);
    /// Ends the lock.
    void release();
    bool isHeld() const { return descriptor_ >= 0; }

private:
    int descriptor_ = -1;
};

} // namespace fx::editor
