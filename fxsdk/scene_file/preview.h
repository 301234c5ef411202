/// @file preview.h
/// How tools show a preset by itself: its member "preview".
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

/// Reads the member "preview" of a valid preset into the scene of one instance that shows it; what the preset
/// does not say stays as it was.
/// @param text     the preset
/// @param resolver finds the mesh and the image that it names
/// @param outDiagnostics receives every finding; may be null
/// @return Schema, or what an asset failed with
base::Result<Preview> readPreview(std::string_view text, const std::string& displayName,
                                  const asset::AssetResolver& resolver, SceneFile& io,
                                  std::vector<preset::Diagnostic>* outDiagnostics = nullptr);

} // namespace fx::scene_file
