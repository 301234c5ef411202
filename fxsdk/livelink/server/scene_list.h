/// @file scene_list.h
/// The presets and instances of scenes as a message.
#pragma once

#include "fxsdk/fx_base.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace fx::link {

constexpr uint32_t kListedInstances = 1000; ///< further instances are counted only
constexpr size_t kListedPresets = 1000;

/// The reply to a request of the type "list".
nlohmann::json sceneList(uint64_t id, FxContext* context, const std::vector<FxPresetId>& presets,
                         std::span<FxScene* const> scenes);

} // namespace fx::link
