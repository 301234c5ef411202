/// @file default_stage.h
/// Default scene for a preset without a scene file: ground, afternoon light, and a camera that sees the
/// effect.
#pragma once

#include "foundation/result/status.h"
#include "foundation/time/ticks.h"
#include "fxsdk/cli/scene/effect_scene.h"
#include "fxsdk/scene_file/preview.h"
#include "fxsdk/scene_file/scene_file.h"

#include <string>

namespace fx::cli {

/// A scene with one instance of the preset at the origin, or as the preset's member "preview" describes.
/// @param input      a file *.fx.json, or library:NAME
/// @param outPreview receives the preset's preview; may be null
/// @param stage      name of scene_file::stages(), whose members replace those of the preview; empty: none
base::Result<scene_file::SceneFile> sceneOfPreset(const std::string& input,
                                                  scene_file::Preview* outPreview = nullptr,
                                                  const std::string& stage = {});

/// A scene as sceneOfPreset() makes it, of a text that need not be saved.
/// @param input name of the text: a file, in whose folder the files that the preset names are searched, or
/// library:NAME
base::Result<scene_file::SceneFile> sceneOfPresetText(const std::string& text, const std::string& input,
                                                      scene_file::Preview* outPreview = nullptr,
                                                      const std::string& stage = {});

/// Lets presets choose the composition and how light is scattered, as tools show a preset.
void followPresets(scene_file::SceneFile& io);

/// Simulates the effect and places the camera so that the effect is in the picture at all moments between
/// the start and `until`. Does nothing if there are no elements at these moments.
/// @param aspect width of the picture over its height
base::Status frameEffect(scene_file::SceneFile& shown, base::Ticks until, const EffectSceneOptions& options,
                         double aspect = 16.0 / 9.0);

} // namespace fx::cli
