/// @file view_settings.h
/// Converts settings of a scene file to structs of the C API.
#pragma once

#include "fxsdk/fxsdk.h"
#include "rendering/frame/scene_light.h"
#include "rendering/frame/view_types.h"

namespace fx::cli {

FxViewSettings toApi(const render::ViewSettings& settings);
FxLight toApi(const render::SceneLight& light);

/// Converts a light of a scene to a light of views.
render::HostLight toHostLight(const render::SceneLight& light);

} // namespace fx::cli
