/// @file scene_members.h
/// Readers of the members of a validated scene. Readers add findings for faults that a schema cannot
/// exclude.
#pragma once

#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/presets/findings.h"
#include "fxsdk/presets/preset_value.h"
#include "fxsdk/scene_file/scene_file.h"

#include <span>
#include <string>

namespace fx::scene_file {

// Plain values (scene_settings.cpp): camera, light, view settings, placement of instances.

CameraPath readCamera(const preset::PresetValue& camera);
render::SceneLight readLight(const preset::PresetValue& light);
/// Reads exposure, lighting, shimmer, dazzle, form, detail, tone map.
render::ViewSettings readView(const preset::PresetValue& root);
/// Reads all members of an instance except "preset".
SceneInstance readInstance(const preset::PresetValue& instance);

// Opaque surroundings (scene_stage.cpp): members that refer to files.

/// Adds a finding: the asset that `member` names could not be read.
void reportAsset(const preset::PresetValue& value, const char* member, const base::Status& status,
                 preset::Findings& findings);

/// Reads the mesh that the member "file" of `value` names. A mesh that cannot be read is a finding.
base::Result<render::StageMesh> readMeshMember(const preset::PresetValue& value,
                                               const asset::AssetResolver& resolver,
                                               preset::Findings& findings);

/// Reads the member "mesh" of a scene into `scene`. If the member is absent, `scene` does not change.
void readSceneMesh(const preset::PresetValue& mesh, const asset::AssetResolver& resolver,
                   preset::Findings& findings, SceneFile& scene);

/// Reads the member "background" of a scene.
void readBackground(const preset::PresetValue& background, const asset::AssetResolver& resolver,
                    preset::Findings& findings, SceneFile& scene);

// Changes of an instance over time (instance_play_reader.cpp).

/// Reads the changes of an instance over time.
/// @param value the instance in the scene; faults are reported as findings
/// @param start [s] start of the instance
InstancePlay readPlay(const preset::PresetValue& value, double start);

/// Adds findings for triggers whose event the preset does not define.
/// @param known names of the preset's host events
void checkTriggers(const preset::PresetValue& value, const InstancePlay& play,
                   std::span<const std::string> known);

} // namespace fx::scene_file
