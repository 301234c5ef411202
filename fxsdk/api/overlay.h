/// @file overlay.h
/// Box and color of an instance in the activation overlay.
#pragma once

#include "fxsdk/scene/scene.h"
#include "rendering/frame/view_types.h"

#include <memory_resource>
#include <span>
#include <vector>

namespace fx::api {

/// The box of each mark, relative to `origin` [m]; the legend is in fx_view.h.
void makeOverlay(std::span<const scene::Mark> marks, const glm::dvec3& origin,
                 std::pmr::vector<render::OverlayBox>& out);

} // namespace fx::api
