/// @file preset_files.h
/// What all presets of imported volumes share.
#pragma once

#include "foundation/result/status.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace fx::cli {

/// The name of a preset's file without ".fx.json". @return InvalidArgument for other names
base::Result<std::string> presetStem(const std::filesystem::path& preset);

/// Sets the mean cosine of the scattering angle [1] of all elements of "volumes" and "clouds", if it is not
/// 0.
void setAnisotropy(double anisotropy, nlohmann::ordered_json& ioPreset);

/// Writes the file that a preset names, and then the preset. @return Io
base::Status writePresetFiles(const std::filesystem::path& preset, const nlohmann::ordered_json& text,
                              const std::filesystem::path& file, std::string_view bytes);

} // namespace fx::cli
