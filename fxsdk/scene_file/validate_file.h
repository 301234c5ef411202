/// @file validate_file.h
/// Checks one file of a user.
#pragma once

#include "fxsdk/presets/diagnostic.h"

#include <string>
#include <vector>

namespace fx::preset {

/// Everything that is wrong with the preset (`*.fx.json`) or scene (`*.scene.json`) at `path`; empty when it
/// is valid. The presets, mesh and image of a scene are checked with it.
std::vector<Diagnostic> validateFile(const std::string& path);

} // namespace fx::preset
