/// @file render_statistics.h
/// Builds one JSON object per frame, for --stats and --json.
#pragma once

#include "fxsdk/cli/render/frame_renderer.h"

#include <nlohmann/json.hpp>

namespace fx::cli {

/// Statistics of a frame. Times are in milliseconds; `allocations` counts allocations of the library during
/// the frame.
nlohmann::json frameStatistics(const FrameCounters& counters, double time, bool withOverdraw);

} // namespace fx::cli
