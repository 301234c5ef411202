/// @file migration.h
/// Migrates documents of older versions to the current one, one version at a time.
#pragma once

#include "fxsdk/presets/findings.h"

#include <nlohmann/json.hpp>

#include <span>

namespace fx::preset {

/// One step: converts a document of version `from` to version `from + 1`. Documents are not validated before
/// the migration, so values of an unexpected type are left unchanged.
struct MigrationStep
{
    int from;
    void (*apply)(nlohmann::json& document, Findings& findings);
};

constexpr int kPresetVersion = 1;
constexpr int kSceneVersion = 1;

std::span<const MigrationStep> presetMigrations();
std::span<const MigrationStep> sceneMigrations();

/// Applies the migrations up to version `current`. The document must state a version of at most `current`.
/// @return false if an error was added to `findings`
bool migrate(nlohmann::json& document, int current, std::span<const MigrationStep> steps, Findings& findings);

} // namespace fx::preset
