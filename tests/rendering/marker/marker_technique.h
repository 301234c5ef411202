/// @file marker_technique.h
/// A whole drawing technique beside those of the library: squares of one color that face the view. It joins a
/// view by its line in the list of techniques, and nothing in the library knows of it.
#pragma once

#include "rendering/techniques/draw_technique.h"

#include <optional>
#include <string>
#include <string_view>

namespace fx::test {

/// Snapshot data of markers: where each is, and what they all look like.
namespace marker {

inline constexpr base::ColumnDesc kColumns[] = {{"x", "m"}, {"y", "m"}, {"z", "m"}};
inline constexpr base::ColumnDesc kConstants[] = {
    {"halfSide", "m"}, {"red", "cd/m2"}, {"green", "cd/m2"}, {"blue", "cd/m2"}};

} // namespace marker

inline constexpr base::KindDesc kMarkerKind{"marker", marker::kColumns, marker::kConstants, false};

extern const render::DrawTechnique kMarkerTechnique;

/// GLSL of the technique's programs, for GlDevice::setSourceOverride().
std::optional<std::string> markerSource(std::string_view name, std::string_view defines);

} // namespace fx::test
