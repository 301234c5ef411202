/// @file autosave.h
/// Keeps the text of an edited document in a file of its own, so that it can be recovered after a crash.
///
/// A recovery file is written atomically, and removed when the document is saved or closed. One that exists
/// when a document is opened is left from a program that ended without closing it, unless a program holds its
/// lock.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/editor/document/document.h"
#include "fxsdk/editor/document/file_lock.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace fx::editor {

/// Folder of recovery files: $XDG_STATE_HOME/fxsdk/recovery, by default ~/.local/state/fxsdk/recovery; the
/// folder for temporary files if neither variable is set.
std::filesystem::path recoveryFolder();

class Autosave
{
public:
    /// @param path   file of the document
    /// @param folder is created with the first write
    explicit Autosave(const std::string& path, std::filesystem::path folder = recoveryFolder());

    /// Returns the text that a crashed program left; nothing if there is none, or if the program that writes
    /// it is still running.
    std::optional<std::string> recoverable() const;
    /// Whether another running program edits the document.
    bool isOpenElsewhere() const;

    /// Writes the document if it has changed since the last write and `interval` has passed; removes the file
    /// of a document that is not dirty.
    /// @return Io
    base::Status update(const Document& document,
                        std::chrono::milliseconds interval = std::chrono::milliseconds(1000));
    /// Removes the recovery file.
    void discard();

    const std::filesystem::path& file() const { return file_; }

private:
    std::filesystem::path lockFile() const;

    std::filesystem::path file_;
    FileLock lock_; ///< held while there is a recovery file of this object
    std::string path_;
    uint64_t revision_ = 0; ///< of the document when it was last written
    bool isWritten_ = false;
    std::chrono::steady_clock::time_point written_;
};

} // namespace fx::editor
