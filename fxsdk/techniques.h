/// @file techniques.h
/// The explicit list of techniques: what each brings to presets, simulation and snapshots, and which passes
/// exist because of it.
///
/// Adding a technique, or leaving one out of a build, touches this list and the technique's own folder,
/// nothing else.
#pragma once

#include "fxsdk/presets/technique.h"

namespace fx::preset {

Techniques techniques();
/// Whether an effect makes use of a technique without a preset member.
bool isUsed(const Technique& technique, const sim::EffectDef& effect);
std::span<const MissingTechnique> missingTechniques();

/// Registers what the techniques publish. Called once per context.
void registerKinds(base::SnapshotSchema& schema, Techniques techniques = preset::techniques());

} // namespace fx::preset
