/// @file scene_settings.h
/// Reads the parts of a scene that are plain values: camera, light, view settings, placement of instances.
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "fxsdk/scene_file/scene_file.h"

namespace fx::scene_file {

// Each reads members of a validated scene and adds findings for what a schema cannot say.

CameraPath readCamera(const preset::PresetValue& camera);
/// Exposure, lighting, shimmer, dazzle, form, detail, tone map.
render::ViewSettings readView(const preset::PresetValue& root);
/// All but the preset.
SceneInstance readInstance(const preset::PresetValue& instance);

} // namespace fx::scene_file
