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

/// One file, or one file for each frame.
struct NumberedFile
{
    std::filesystem::path path;
    /// position of the placeholder "%0Nd" in the file name; npos for a single file
    size_t numberAt = std::string::npos;
    size_t numberLength = 0; ///< [character] length of the placeholder
    int digits = 0;          ///< minimum number of digits

    bool isSequence() const { return numberAt != std::string::npos; }
    /// The file of one frame; `path` itself for a single file.
    std::filesystem::path frame(int64_t number) const;
};

struct OutputTarget : NumberedFile
{
    OutputKind kind = OutputKind::Png;

    bool isStill() const { return kind != OutputKind::Mp4 && !isSequence(); }
};

/// Parses NAME and NAME with one placeholder %d, %4d or %04d, whatever the suffix. "%%" is refused.
/// @return InvalidArgument naming the allowed forms
base::Result<NumberedFile> parseNumberedFile(const std::string& text);

/// The suffix of a path, in lower case.
std::string suffixOf(const std::filesystem::path& path);

/// Parses NAME.png, NAME.exr, NAME.mp4 and NAME with one placeholder %d, %4d or %04d. "%%" is refused.
/// @return InvalidArgument naming the allowed forms
base::Result<OutputTarget> parseOutputTarget(const std::string& text);

} // namespace fx::cli
