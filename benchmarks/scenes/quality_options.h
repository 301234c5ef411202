/// @file quality_options.h
/// Options that fx calibrate and fx bench budget share.
#pragma once

#include "benchmarks/scenes/quality_stage.h"
#include "foundation/result/status.h"

#include <optional>
#include <string>

namespace fx::cli {

/// "320x180", each 16 to 16384. @return InvalidArgument
base::Status readSize(const std::string& text, int& outWidth, int& outHeight);

/// "gpu", "wall", "processor", or "auto" for nothing. @return InvalidArgument
base::Status readClock(const std::string& text, std::optional<StageClock>& outClock);

} // namespace fx::cli
