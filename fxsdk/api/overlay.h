/// @file overlay.h
/// Boxes and colors of instances in the activation overlay.
#pragma once

#include "fxsdk/scene/scene.h"
#include "rendering/frame/view_types.h"

#include <memory_resource>
#include <span>
#include <vector>

namespace fx::api {

/// Creates the box of each mark in the activation overlay, relative to `origin` [m]. The colors are explained
/// at FxViewSettings::activationOverlay.
void makeOverlay(std::span<const scene::Mark> marks, const glm::dvec3& origin,
                 std::pmr::vector<render::OverlayBox>& out);

} // namespace fx::api
