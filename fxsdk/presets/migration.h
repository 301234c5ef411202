/// @file migration.h
/// Brings documents of older versions up to date, one version at a time.
#pragma once

#include "fxsdk/presets/findings.h"

#include <nlohmann/json.hpp>

#include <span>

namespace fx::preset {

/// One step: turns a document of version `from` into one of version `from + 1`. Documents are not validated
/// yet, so values of an unexpected shape are left unchanged.
struct MigrationStep
{
    int from;
    void (*apply)(nlohmann::json& document, Findings& findings);
};

constexpr int kPresetVersion = 1;
constexpr int kSceneVersion = 1;

std::span<const MigrationStep> presetMigrations();
std::span<const MigrationStep> sceneMigrations();

/// Applies the migrations up to version `current`. The document must have a version, at most `current`.
/// @return false when `findings` got an error
bool migrate(nlohmann::json& document, int current, std::span<const MigrationStep> steps, Findings& findings);

} // namespace fx::preset
