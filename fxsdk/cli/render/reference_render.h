/// @file reference_render.h
/// fx render --renderer reference: scenes, presets and lists of blobs to EXR files, without a GPU.
#pragma once

#include "fxsdk/cli/render/render_options.h"
#include "fxsdk/scene_file/scene_file.h"

#include <functional>
#include <string>

namespace fx::cli {

/// Whether the input is a list of blobs, which only the reference renderer draws.
bool isBlobList(const std::string& input);

/// Renders all frames of `plan`.
/// @param loadScene gives the scene; not called for a list of blobs
/// @return an exit code; messages went to standard error
int runReference(const RenderArguments& arguments, const RenderPlan& plan,
                 const std::function<base::Result<scene_file::SceneFile>()>& loadScene);

} // namespace fx::cli
