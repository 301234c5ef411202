/// @file preset_loader.h
/// From the text of a preset (`*.fx.json`) to an effect that can run, or to everything that is wrong with it.
///
/// Threads: any; nothing is shared between calls. Nothing is read but what the call names.
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

/// The presets that are compiled in; names are `NAME.fx.json`.
std::span<const base::EmbeddedText> presetLibrary();
/// The same, followed by the files that they name: what a resolver takes as its library.
std::span<const base::EmbeddedText> libraryFiles();

/// Where images and meshes that presets name go to.
struct PresetAssets
{
    base::AssetTable* table = nullptr; ///< null: they are read, checked and forgotten
    asset::MissingAsset missing = asset::MissingAsset::IsAnError;
};

/// Parses, migrates, validates and builds. The status of a failure holds the first findings.
/// @param displayName names the text in messages
/// @param outDiagnostics receives every finding, warnings included, whether it fails or not; may be null
/// @param resolver where files that the preset names come from; null: from the library alone
/// @param folder   of the preset below the resolver's folder, with '/' at its end
/// @param techniques what the preset's members can be
/// @return Parse, TooLarge, Version, Schema
base::Result<LoadedPreset> loadPresetText(std::string_view text, const std::string& displayName,
                                          std::vector<Diagnostic>* outDiagnostics = nullptr,
                                          const asset::AssetResolver* resolver = nullptr,
                                          const PresetAssets& assets = {}, const std::string& folder = {},
                                          Techniques techniques = preset::techniques());

/// The same for an asset: `library:NAME`, or a name relative to the resolver's folder.
/// Files that it names are relative to it.
base::Result<LoadedPreset> loadPresetAsset(std::string_view name, const asset::AssetResolver& resolver,
                                           std::vector<Diagnostic>* outDiagnostics = nullptr,
                                           const PresetAssets& assets = {},
                                           Techniques techniques = preset::techniques());

/// Folder of an asset, with '/' at its end; empty when it lies in the resolver's.
std::string folderOf(std::string_view name);

/// The same for a file anywhere.
base::Result<LoadedPreset> loadPresetFile(const std::string& path,
                                          std::vector<Diagnostic>* outDiagnostics = nullptr,
                                          const PresetAssets& assets = {},
                                          Techniques techniques = preset::techniques());

} // namespace fx::preset
