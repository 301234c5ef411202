/// @file output_target.h
/// The kind of output that the argument of `-o` names: a still, a numbered sequence, or a video.
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
    size_t numberAt = std::string::npos; ///< where "%0Nd" begins in the file name; npos for a single file
    size_t numberLength = 0;             ///< [character] of that place holder
    int digits = 0;                      ///< least number of digits

    bool isSequence() const { return numberAt != std::string::npos; }
    bool isStill() const { return kind != OutputKind::Mp4 && !isSequence(); }
    /// The file of one frame; `path` itself for a single file.
    std::filesystem::path frame(int64_t number) const;
};

/// Parses NAME.png, NAME.exr, NAME.mp4 and NAME with one placeholder %d, %4d or %04d. "%%" is refused.
/// @return InvalidArgument naming the allowed forms
base::Result<OutputTarget> parseOutputTarget(const std::string& text);

} // namespace fx::cli
