/// @file preset_loader.h
/// From the text of a preset (`*.fx.json`) to an effect that can run, or to everything that is wrong with it.
///
/// Threads: any; nothing is shared between calls. Nothing is read but what the call names.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/presets/diagnostic.h"
#include "simulation/effect_def.h"

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

/// Parses, migrates, validates and builds. The status of a failure holds the first findings.
/// @param displayName names the text in messages
/// @param outDiagnostics receives every finding, warnings included, whether it fails or not; may be null
/// @param assets where files that the preset names come from; null: naming one is an error
/// @return Parse, TooLarge, Version, Schema
base::Result<LoadedPreset> loadPresetText(std::string_view text, const std::string& displayName,
                                          std::vector<Diagnostic>* outDiagnostics = nullptr,
                                          const asset::AssetResolver* assets = nullptr);

/// The same for an asset: `library:NAME`, or a name relative to the resolver's folder.
base::Result<LoadedPreset> loadPresetAsset(std::string_view name, const asset::AssetResolver& resolver,
                                           std::vector<Diagnostic>* outDiagnostics = nullptr);

/// The same for a file anywhere.
base::Result<LoadedPreset> loadPresetFile(const std::string& path,
                                          std::vector<Diagnostic>* outDiagnostics = nullptr);

} // namespace fx::preset
