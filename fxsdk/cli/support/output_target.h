/// @file output_target.h
/// The kind of output that the argument of `-o` requests: a still, a numbered sequence, or a video.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace fx::cli {

enum class OutputKind
{
    Png,
    Exr,
    Mp4,
};

struct OutputTarget
{
    OutputKind kind = OutputKind::Png;
    std::filesystem::path path;
    /// position of the placeholder "%0Nd" in the file name; npos for a single file
    size_t numberAt = std::string::npos;
    size_t numberLength = 0; ///< [character] length of the placeholder
    int digits = 0;          ///< minimum number of digits

    bool isSequence() const { return numberAt != std::string::npos; }
    bool isStill() const { return kind != OutputKind::Mp4 && !isSequence(); }
    /// The file of one frame; `path` itself if there is a single file.
    std::filesystem::path frame(int64_t number) const;
};

/// Parses NAME.png, NAME.exr and NAME.mp4, where NAME may contain one placeholder %d, %4d or %04d.
/// @return InvalidArgument naming the allowed forms, also for "%%"
base::Result<OutputTarget> parseOutputTarget(const std::string& text);

} // namespace fx::cli
