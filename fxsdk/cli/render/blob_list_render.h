/// @file blob_list_render.h
/// Implements fx render --renderer gl for a list of blobs: PNG, EXR, a sequence or a video.
#pragma once

#include "fxsdk/cli/render/render_options.h"
#include "fxsdk/scene_file/scene_file.h"

namespace fx::cli {

/// Renders all frames of `plan`.
/// @param lights scene of --lights; null without the option
/// @return an exit code; messages went to standard error
int runBlobList(const RenderArguments& arguments, const RenderPlan& plan,
                const scene_file::SceneFile* lights);

} // namespace fx::cli
