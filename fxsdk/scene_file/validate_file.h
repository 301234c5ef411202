/// @file validate_file.h
/// Checks one file of a user.
#pragma once

#include "fxsdk/presets/diagnostic.h"

#include <cstdint>
#include <string>
#include <vector>

namespace fx::preset {

/// Everything that is wrong with the preset (`*.fx.json`) or scene (`*.scene.json`) at `path`; empty when it
/// is valid. The presets, mesh and image of a scene are checked with it.
/// @param outBytes receives the bytes that emitters take in each instance of a valid preset, else 0; may be
/// null
std::vector<Diagnostic> validateFile(const std::string& path, uint64_t* outBytes = nullptr);

} // namespace fx::preset
