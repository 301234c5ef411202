/// @file validate_file.h
/// Validates a preset or scene file.
#pragma once

#include "fxsdk/presets/diagnostic.h"
#include "simulation/solver/effect_def.h"

#include <cstdint>
#include <string>
#include <vector>

namespace fx::preset {

/// Estimated cost of an instance of a preset.
struct Needs
{
    uint64_t solverBytes = 0; ///< [byte] maximum memory of the solvers of the instance
    sim::EffectCost cost;
};

/// Returns the findings about the preset (`*.fx.json`) or scene (`*.scene.json`) at `path`; empty if the
/// file is valid. For a scene, its presets, mesh and image are also checked.
/// @param outNeeds receives the estimated cost of an instance of a valid preset; may be null
std::vector<Diagnostic> validateFile(const std::string& path, Needs* outNeeds = nullptr);

} // namespace fx::preset
