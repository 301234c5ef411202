/// @file view_settings.h
/// A scene's settings in the terms of the C API.
#pragma once

#include "fxsdk/fxsdk.h"
#include "rendering/frame/scene_light.h"
#include "rendering/frame/view_types.h"

namespace fx::cli {

FxViewSettings toApi(const render::ViewSettings& settings);
FxLight toApi(const render::SceneLight& light);

/// A light of a scene in the terms of views.
render::HostLight toHostLight(const render::SceneLight& light);

} // namespace fx::cli
