/// @file tiled_render.h
/// Implements fx render --renderer reference and path: renders scenes, presets and lists of blobs to EXR
/// files without a GPU.
#pragma once

#include "fxsdk/cli/render/render_options.h"
#include "fxsdk/scene_file/scene_file.h"

#include <functional>
#include <string>

namespace fx::cli {

/// Whether the input is a list of blobs.
bool isBlobList(const std::string& input);

/// Renders all frames of `plan`.
/// @param loadScene returns the scene with the lights of --lights; not called for a list of blobs
/// @param lights    scene of --lights, null without the option; must outlive the call
/// @return an exit code; messages went to standard error
int runTiled(const RenderArguments& arguments, const RenderPlan& plan, const scene_file::SceneFile* lights,
             const std::function<base::Result<scene_file::SceneFile>()>& loadScene);

} // namespace fx::cli
