/// @file instance_play_reader.h
/// Reads the members of a scene's instance that say what happens to it.
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "fxsdk/scene_file/instance_play.h"

#include <span>

namespace fx::scene_file {

/// @param value  the instance; what is wrong becomes findings
/// @param start  [s] of the instance
InstancePlay readPlay(const preset::PresetValue& value, double start);

/// Findings for triggers that the preset does not hear.
/// @param known names of its events of the kind "host"
void checkTriggers(const preset::PresetValue& value, const InstancePlay& play,
                   std::span<const std::string> known);

} // namespace fx::scene_file
