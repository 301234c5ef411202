/// @file preset_loading.h
/// Loads presets into a context, at once or with a monitor.
#pragma once

#include "fxsdk/api/context.h"
#include "fxsdk/assets/load_monitor.h"

#include <string>
#include <string_view>

namespace fx::api {

constexpr std::string_view kLibraryPrefix = "library:";

/// A preset at a path, whose text may be given.
struct PresetSource
{
    std::string path;
    std::string_view text;
    bool hasText = false; ///< false: the file at `path` is read
};

/// Ok for the length of a text that may be a preset [byte].
base::Status checkPresetLength(size_t length);

/// Loads a preset under the context's lock and enters it into its table. After a failure, and when the
/// monitor throws LoadCanceled, the context is as before.
/// @param monitor null: nobody waits
/// @param outPreset untouched on failure
base::Status loadPreset(FxContext& context, const PresetSource& source, asset::LoadMonitor* monitor,
                        FxPresetId& outPreset);
/// Loads a preset of the built-in library. @param name with kLibraryPrefix
base::Status loadLibraryPreset(FxContext& context, const std::string& name, asset::LoadMonitor* monitor,
                               FxPresetId& outPreset);
/// Loads a text that can name files of the library only. @param name of the text in messages
base::Status loadPresetText(FxContext& context, std::string_view text, const std::string& name,
                            FxPresetId& outPreset);

} // namespace fx::api
