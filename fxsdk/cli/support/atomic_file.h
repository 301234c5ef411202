/// @file atomic_file.h
/// Atomic replacement of files. A file is written under a temporary name in the same folder, flushed to the
/// disk, and then renamed.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/cli/support/interrupt.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace fx::cli {

/// A temporary name in the folder of `target` that no other process uses. The name keeps the suffix of
/// `target`, by which programs recognize the format.
std::filesystem::path temporaryNameFor(const std::filesystem::path& target);

/// A file that appears under its name only at commit(). Without commit() the temporary file is removed. A
/// target that exists and is not a regular file (a pipe, /dev/null) is written directly.
class AtomicFile
{
public:
    explicit AtomicFile(std::filesystem::path target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Opens the temporary file. @return Io naming the file and the system's reason
    base::Status open();
    base::Status write(std::string_view bytes);
    /// Renames the temporary file to its final name.
    /// @param durable true: waits until the bytes are on the disk; after a crash of the machine, either the
    ///          old or the new file exists. false: after a crash the file may be incomplete
    base::Status commit(bool durable = true);

private:
    base::Status failed(const char* what) const;

    std::filesystem::path target_;
    std::filesystem::path temporary_; ///< path of the temporary file; empty if the target is written directly
    EndsWithProgram entered_;         ///< registers the temporary file for removal when the program ends
    int descriptor_ = -1;
};

/// Checks a target before a long computation.
/// @return Io when `target` is a folder or its folder does not exist
base::Status checkTarget(const std::filesystem::path& target);

/// Calls open(), write() and commit() of an AtomicFile.
base::Status writeFileAtomically(const std::filesystem::path& target, std::string_view bytes);

} // namespace fx::cli
