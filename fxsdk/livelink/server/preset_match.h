/// @file preset_match.h
/// Finds the preset of a game that a client means.
#pragma once

#include "foundation/result/status.h"

#include <cstddef>
#include <string>
#include <vector>

namespace fx::link {

/// A preset of the game.
struct NamedPreset
{
    std::string source; ///< file, or name under which it was loaded
    std::string name;   ///< name in the preset
};

/// Indices of the presets that `wanted` names. The first rule that fits any preset decides: equal to the
/// source; the same file, where one of the two paths is a relative part of the other; the same file name;
/// equal to the name in the preset.
/// @return NotFound; Capacity if presets of several sources fit. Messages list the candidates
base::Result<std::vector<size_t>> matchPreset(const std::string& wanted,
                                              const std::vector<NamedPreset>& presets);

} // namespace fx::link
