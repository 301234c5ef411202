/// @file frame_range.h
/// The arguments `--time` and `--frames`, and other pairs of whole numbers.
#pragma once

#include "foundation/result/status.h"
#include "foundation/time/ticks.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fx::cli {

constexpr double kMaxSceneTime = 3600.0; // [s] largest scene time of commands

/// Parses two whole numbers with `separator` between them; empty for any other text.
std::optional<std::pair<long, long>> parsePair(const std::string& text, char separator);

/// First and last frame.
struct FrameRange
{
    int64_t first = 0;
    int64_t last = 0;
};

/// Parses a range of frames. @param text FIRST:LAST; empty: the first two seconds
/// @return InvalidArgument naming the allowed form, and the limits: a million frames within kMaxSceneTime
base::Result<FrameRange> parseFrameRange(const std::string& text, double framesPerSecond);

/// A moment and its number in file names.
struct NumberedFrame
{
    int64_t number = 0;
    base::Ticks tick = 0;
};

/// The arguments of a command that choose moments.
struct FrameArguments
{
    std::optional<double> time; ///< [s] argument of --time
    std::string frames;         ///< argument of --frames
    double framesPerSecond = 30.0;
};

/// Lists the moments of an output. A single file has one moment, at --time or at `defaultTime`.
/// @param defaultTime [s] time of a single file without --time
/// @param sequenceForm, stillForm names of the outputs that --frames and --time require, for messages
/// @return InvalidArgument for --frames with a single file, --time with a sequence, or a malformed range
base::Result<std::vector<NumberedFrame>> listFrames(const FrameArguments& arguments, bool isSingleFile,
                                                    double defaultTime, const std::string& sequenceForm,
                                                    const std::string& stillForm);

} // namespace fx::cli
