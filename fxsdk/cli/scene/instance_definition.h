/// @file instance_definition.h
/// Instances of scene files as the C API describes them.
#pragma once

#include "fxsdk/fx_scene.h"
#include "fxsdk/scene_file/scene_file.h"

namespace fx::cli {

/// An instance that begins with the next step.
/// @param time [s] of the scene, at which the instance is where its motion has brought it
FxInstanceDef instanceDefinition(const scene_file::SceneInstance& instance, FxPresetId preset, double time);

} // namespace fx::cli
