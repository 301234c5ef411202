/// @file scene_stage.h
/// Reads what stands behind the effects of a scene: the mesh and the background, with the files that they
/// name.
#pragma once

#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/presets/findings.h"
#include "fxsdk/presets/preset_value.h"
#include "fxsdk/scene_file/scene_file.h"

namespace fx::scene_file {

/// Adds to `findings` that the asset named by the member could not be read.
void reportAsset(const preset::PresetValue& value, const char* member, const base::Status& status,
                 preset::Findings& findings);

/// Reads the member "mesh" of a scene into `scene`, which keeps what it had without one.
void readSceneMesh(const preset::PresetValue& mesh, const asset::AssetResolver& resolver,
                   preset::Findings& findings, SceneFile& scene);

/// Reads the member "background" of a scene.
void readBackground(const preset::PresetValue& background, const asset::AssetResolver& resolver,
                    preset::Findings& findings, SceneFile& scene);

} // namespace fx::scene_file
