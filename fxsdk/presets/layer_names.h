/// @file layer_names.h
/// Names of media layers in presets.
#pragma once

#include "foundation/snapshot/blob_kind.h"

#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace fx::preset {

inline constexpr std::array<std::pair<std::string_view, base::MediaLayer>, 3> kLayerNames{{
    {"fire", base::MediaLayer::Fire},
    {"smoke", base::MediaLayer::Smoke},
    {"dust", base::MediaLayer::Dust},
}};

} // namespace fx::preset
