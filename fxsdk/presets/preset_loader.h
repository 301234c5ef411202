/// @file preset_loader.h
/// Loads a preset (`*.fx.json`) as an effect, or reports all findings.
///
/// Threads: any; calls share no data. Only the given text and its assets are read.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/assets/asset_loader.h"
#include "fxsdk/presets/diagnostic.h"
#include "fxsdk/techniques.h"
#include "simulation/solver/effect_def.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace fx::preset {

/// A preset ready to run.
struct LoadedPreset
{
    std::shared_ptr<const sim::EffectDef> effect;
    std::vector<Diagnostic> warnings;
};

/// Largest preset that is read [byte].
constexpr uint64_t kPresetBytes = uint64_t(4) << 20;

/// The presets that are compiled into the library; names are `NAME.fx.json`.
std::span<const base::EmbeddedText> presetLibrary();
/// The presets and their assets, as the library of a resolver.
std::span<const base::EmbeddedText> libraryFiles();

/// Table to which images and meshes of presets are added, and who follows the load.
struct PresetAssets
{
    base::AssetTable* table = nullptr; ///< null: assets are read and checked, but not stored
    asset::MissingAsset missing = asset::MissingAsset::IsAnError;
    asset::LoadMonitor* monitor = nullptr; ///< of this load; null: nobody waits. May throw LoadCanceled
};

/// Parses, migrates and validates a preset and builds its effect. On failure the status holds the first
/// findings.
/// @param displayName name of the text in messages
/// @param outDiagnostics receives all findings, including warnings, on success and on failure; may be null
/// @param resolver reads files that the preset names; null: only files of the library are found
/// @param folder   folder of the preset below the resolver's folder, ending with '/'
/// @param techniques techniques that define the members of the preset
/// @return Parse, TooLarge, Version, Schema
base::Result<LoadedPreset> loadPresetText(std::string_view text, const std::string& displayName,
                                          std::vector<Diagnostic>* outDiagnostics = nullptr,
                                          const asset::AssetResolver* resolver = nullptr,
                                          const PresetAssets& assets = {}, const std::string& folder = {},
                                          Techniques techniques = preset::techniques());

/// Loads a preset from an asset: `library:NAME`, or a name relative to the resolver's folder. Names of files
/// in the preset are relative to the folder of the preset.
base::Result<LoadedPreset> loadPresetAsset(std::string_view name, const asset::AssetResolver& resolver,
                                           std::vector<Diagnostic>* outDiagnostics = nullptr,
                                           const PresetAssets& assets = {},
                                           Techniques techniques = preset::techniques());

/// Folder of an asset, ending with '/'; empty when the asset lies in the resolver's folder.
std::string folderOf(std::string_view name);

/// Loads a preset from a file at any path.
base::Result<LoadedPreset> loadPresetFile(const std::string& path,
                                          std::vector<Diagnostic>* outDiagnostics = nullptr,
                                          const PresetAssets& assets = {},
                                          Techniques techniques = preset::techniques());

} // namespace fx::preset
