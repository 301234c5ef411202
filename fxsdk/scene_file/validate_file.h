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
    uint64_t solverBytes = 0; ///< [byte] maximum memory of its solvers
    sim::EffectCost cost;
};

/// Findings about the preset (`*.fx.json`) or scene (`*.scene.json`) at `path`; empty if it is valid. The
/// presets, mesh and image of a scene are checked too.
/// @param outNeeds receives the estimated cost of an instance of a valid preset; may be null
std::vector<Diagnostic> validateFile(const std::string& path, Needs* outNeeds = nullptr);

} // namespace fx::preset
