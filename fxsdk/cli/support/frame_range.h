/// @file frame_range.h
/// The argument of `--frames`, and other pairs of whole numbers.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace fx::cli {

constexpr double kMaxSceneTime = 3600.0; // [s] that commands go to

/// Two whole numbers around `separator`, nothing else.
std::optional<std::pair<long, long>> parsePair(const std::string& text, char separator);

/// First and last frame.
struct FrameRange
{
    int64_t first = 0;
    int64_t last = 0;
};

/// @param text FIRST:LAST; empty: the first two seconds
/// @return InvalidArgument naming the allowed form, and the limits: a million frames within kMaxSceneTime
base::Result<FrameRange> parseFrameRange(const std::string& text, double framesPerSecond);

} // namespace fx::cli
