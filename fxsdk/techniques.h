/// @file techniques.h
/// The explicit list of techniques that presets have members for, and of the snapshot data that their solvers
/// publish. The list of techniques that draw such data is rendering/techniques/draw_techniques.h.
///
/// To add a technique, or to leave one out of a build, a line is added to this list or removed from it.
#pragma once

#include "fxsdk/presets/technique.h"

namespace fx::preset {

Techniques techniques();
std::span<const MissingTechnique> missingTechniques();

/// Registers the kinds that the techniques publish. Called once per context.
void registerKinds(base::SnapshotSchema& schema, Techniques techniques = preset::techniques());

} // namespace fx::preset
