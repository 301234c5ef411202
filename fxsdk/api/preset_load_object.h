/// @file preset_load_object.h
/// Implementation of FxPresetLoad.
#pragma once

#include "fxsdk/api/context.h"
#include "fxsdk/assets/load_monitor.h"
#include "fxsdk/fx_preset_load.h"

#include <memory_resource>
#include <mutex>
#include <string>

struct FxPresetLoad
{
    explicit FxPresetLoad(FxContext* owner) : context(owner), path(&owner->memory), text(&owner->memory) {}

    FxContext* const context;
    std::pmr::string path; ///< constant after fxBeginPresetLoad(), as the next two
    std::pmr::string text;
    bool hasText = false;
    fx::asset::LoadMonitor monitor;

    std::mutex mutex; ///< guards the members below; locked only for a short time
    FxPresetLoadState state = FX_PRESET_LOAD_WAITING;
    fx::base::Status outcome; ///< when the load has ended
    FxPresetId preset{};      ///< when the load is ready
    bool isTaken = false;     ///< true: the host has the id
};

namespace fx::api {

/// Frees a load that does not run.
void freePresetLoad(FxPresetLoad* load);

} // namespace fx::api
