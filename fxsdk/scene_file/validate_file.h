/// @file validate_file.h
/// Checks one file of a user.
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
    uint64_t solverBytes = 0; ///< [byte] that its solvers can take
    sim::EffectCost cost;
};

/// All faults of the preset (`*.fx.json`) or scene (`*.scene.json`) at `path`; empty when it is valid. The
/// presets, mesh and image of a scene are checked too.
/// @param outNeeds receives the estimated cost of an instance of a valid preset; may be null
std::vector<Diagnostic> validateFile(const std::string& path, Needs* outNeeds = nullptr);

} // namespace fx::preset
