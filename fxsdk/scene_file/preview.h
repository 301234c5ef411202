/// @file preview.h
/// The member "preview" of a preset, by which tools show it.
#pragma once

#include "fxsdk/scene_file/scene_file.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fx::scene_file {

struct Preview
{
    std::optional<double> time; ///< [s] of a still, when the preset names one
    bool hasCamera = false;     ///< the scene's camera is the preset's
};

/// Reads the member "preview" of a valid preset into a scene with one instance; absent members do not change
/// the scene.
/// @param text     the preset
/// @param resolver finds the mesh and the image of the preview
/// @param outDiagnostics receives all findings; may be null
/// @return Schema, or the error of an asset
base::Result<Preview> readPreview(std::string_view text, const std::string& displayName,
                                  const asset::AssetResolver& resolver, SceneFile& io,
                                  std::vector<preset::Diagnostic>* outDiagnostics = nullptr);

} // namespace fx::scene_file
