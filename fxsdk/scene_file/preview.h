/// @file preview.h
/// The member "preview" of a preset, which defines how tools show the preset.
#pragma once

#include "fxsdk/scene_file/scene_file.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fx::scene_file {

struct Preview
{
    std::optional<double> time; ///< [s] time of a still picture; empty: the preset states no time
    bool hasCamera = false;     ///< true: the preset defines the camera of the scene
};

/// Reads the member "preview" of a valid preset into a scene with one instance. Absent members do not change
/// the scene.
/// @param text     text of the preset
/// @param resolver finds the mesh and the image of the preview
/// @param outDiagnostics receives all findings; may be null
/// @return Schema, or the error of an asset
base::Result<Preview> readPreview(std::string_view text, const std::string& displayName,
                                  const asset::AssetResolver& resolver, SceneFile& io,
                                  std::vector<preset::Diagnostic>* outDiagnostics = nullptr);

} // namespace fx::scene_file
