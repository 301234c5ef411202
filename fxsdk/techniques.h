/// @file techniques.h
/// The list of techniques that define preset members, and registration of the snapshot data that their
/// solvers publish. rendering/techniques/draw_techniques.h lists the techniques that draw the data.
///
/// To add a technique to a build, add a line to the list. To exclude a technique, remove its line.
#pragma once

#include "fxsdk/presets/technique.h"

namespace fx::preset {

Techniques techniques();
std::span<const MissingTechnique> missingTechniques();

/// Registers the kinds of snapshot data that the techniques publish. Called once per context.
void registerKinds(base::SnapshotSchema& schema, Techniques techniques = preset::techniques());

} // namespace fx::preset
