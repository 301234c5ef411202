/// @file validate_file.h
/// Checks one file of a user.
#pragma once

#include "fxsdk/presets/diagnostic.h"
#include "simulation/solver/effect_def.h"

#include <cstdint>
#include <string>
#include <vector>

namespace fx::preset {

/// What an instance of a preset needs.
struct Needs
{
    uint64_t solverBytes = 0; ///< [byte] that its solvers can take
    sim::EffectCost cost;
};

/// Everything that is wrong with the preset (`*.fx.json`) or scene (`*.scene.json`) at `path`; empty when it
/// is valid. The presets, mesh and image of a scene are checked with it.
/// @param outNeeds receives what an instance of a valid preset needs, else nothing; may be null
std::vector<Diagnostic> validateFile(const std::string& path, Needs* outNeeds = nullptr);

} // namespace fx::preset
