/// @file calibration_file.h
/// Reads and writes quality calibrations as JSON text. Messages name file, position and remedy.
///
/// Threads: any; calls share no data.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/quality/scalability_levels.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace fx::quality {

/// [byte] Largest size of a calibration.
constexpr size_t kCalibrationBytes = size_t(64) << 10;

/// Parses a calibration.
/// @param displayName name of the text in messages
/// @return Parse, TooLarge, Version, Schema with the first findings, one per line
base::Result<Calibration> readCalibration(std::string_view text, const std::string& displayName);

/// Returns the built-in calibration.
base::Result<Calibration> builtInCalibration();

nlohmann::ordered_json toJson(const Calibration& calibration);
nlohmann::ordered_json toJson(const Knobs& knobs);
/// Formats knobs for display: {"particles": 0.5, "detail": true} gives "particles 0.5, detail on".
std::string toText(const Knobs& knobs);
/// Returns a calibration as text for readCalibration(), one level per line.
std::string calibrationText(const Calibration& calibration);

} // namespace fx::quality
