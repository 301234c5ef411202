/// @file calibration_file.h
/// Quality calibrations as JSON text: read with messages that name file, place and remedy, and written.
///
/// Threads: any; nothing is shared between calls.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/quality/scalability_levels.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace fx::quality {

/// Largest calibration that is read [byte].
constexpr size_t kCalibrationBytes = size_t(64) << 10;

/// @param displayName names the text in messages
/// @return Parse, TooLarge, Version, Schema with the first findings, one a line
base::Result<Calibration> readCalibration(std::string_view text, const std::string& displayName);

/// The calibration that is built in.
base::Result<Calibration> builtInCalibration();

nlohmann::ordered_json toJson(const Calibration& calibration);
nlohmann::ordered_json toJson(const Knobs& knobs);
/// Text of knobs for display: {"particles": 0.5, "detail": true} gives "particles 0.5, detail on".
std::string toText(const Knobs& knobs);
/// Text for readCalibration(), one step a line.
std::string calibrationText(const Calibration& calibration);

} // namespace fx::quality
