/// @file marker_technique.h
/// The drawing half of a technique that is not part of the library: squares of one color that face the view.
/// The test adds the technique to the list of techniques of a view. The library does not refer to the
/// technique.
#pragma once

#include "rendering/techniques/draw_technique.h"
#include "tests/marker/marker_kind.h"

#include <optional>
#include <string>
#include <string_view>

namespace fx::test {

extern const render::DrawTechnique kMarkerTechnique;

/// GLSL source of the technique's programs, for GlDevice::setSourceOverride(); empty for unknown names.
std::optional<std::string> markerSource(std::string_view name, std::string_view defines);

} // namespace fx::test
