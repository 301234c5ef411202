/// @file ray_settings.h
/// Common settings of techniques that integrate along rays.
#pragma once

#include "benchmarks/accuracy/accuracy_technique.h"
#include "rendering/reference/integral/ray_records.h"

#include <vector>

namespace fx::cli {

/// Creates one setting for each of render::comparedSchemes(). The published scheme is first.
/// AccuracySetting::tier marks the schemes that the library uses.
std::vector<AccuracySetting> schemeSettings(const nlohmann::json& parameters);

nlohmann::json toJson(const render::RayWork& work);

} // namespace fx::cli
