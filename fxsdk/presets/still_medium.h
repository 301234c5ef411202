/// @file still_medium.h
/// Members that techniques share whose medium does not move, or is played from files.
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/solver/sequence_time.h"
#include "simulation/solver/still_medium.h"

namespace fx::preset {

/// Reads all members of StillMediumDef; absent ones keep their defaults.
void readStillMedium(const PresetValue& element, sim::StillMediumDef& out);

/// Reads the member "end".
void readSequenceEnd(const PresetValue& element, sim::SequenceEnd& out);

} // namespace fx::preset
