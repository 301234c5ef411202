/// @file view_settings.h
/// A scene's settings in the terms of the C API.
#pragma once

#include "fxsdk/fxsdk.h"
#include "rendering/frame/view_types.h"

namespace fx::cli {

FxViewSettings toApi(const render::ViewSettings& settings);

} // namespace fx::cli
