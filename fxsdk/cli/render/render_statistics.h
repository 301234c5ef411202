/// @file render_statistics.h
/// One JSON object a frame, for --stats and --json.
#pragma once

#include "fxsdk/cli/render/frame_renderer.h"

#include <nlohmann/json.hpp>

namespace fx::cli {

/// Statistics of a frame. Times are in milliseconds; `allocations` are those of the library during the frame.
nlohmann::json frameStatistics(const FrameCounters& counters, double time, bool withOverdraw);

} // namespace fx::cli
