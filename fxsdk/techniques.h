/// @file techniques.h
/// The list of techniques that define preset members, and of the snapshot data that their solvers publish.
/// The techniques that draw this data are listed in rendering/techniques/draw_techniques.h.
///
/// To add a technique to a build, add a line to this list; to exclude a technique, remove its line.
#pragma once

#include "fxsdk/presets/technique.h"

namespace fx::preset {

Techniques techniques();
std::span<const MissingTechnique> missingTechniques();

/// Registers the kinds that the techniques publish. Called once per context.
void registerKinds(base::SnapshotSchema& schema, Techniques techniques = preset::techniques());

} // namespace fx::preset
