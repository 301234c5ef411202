/// @file file_watch.h
/// Notices when a file changes outside of the editor.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace fx::editor {

class FileWatch
{
public:
    /// Watches `path` from its present state on.
    /// @param interval shortest time between two looks at the file
    explicit FileWatch(std::filesystem::path path,
                       std::chrono::milliseconds interval = std::chrono::milliseconds(250));

    /// Returns the new text when the file has changed since the last call and its text differs from `known`;
    /// otherwise nothing, also for a file that is missing or cannot be read.
    std::optional<std::string> changedText(const std::string& known);

private:
    struct Stamp
    {
        int64_t seconds = 0;
        int64_t nanoseconds = 0;
        uint64_t inode = 0;
        uint64_t bytes = 0;
        bool operator==(const Stamp&) const = default;
    };
    Stamp stampNow() const;

    std::filesystem::path path_;
    std::chrono::milliseconds interval_;
    std::chrono::steady_clock::time_point looked_;
    Stamp stamp_;
};

} // namespace fx::editor
