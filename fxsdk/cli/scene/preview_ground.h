/// @file preview_ground.h
/// Ground for previews of presets: dry soil with patches of several sizes, up to the horizon. The ground is
/// flat, like the ground plane that effects collide with; its relief is one of normals (formula
/// soil-texture).
#pragma once

#include "rendering/stage/stage_renderer.h"

namespace fx::cli {

/// Adds the ground, y = 0 around the origin. Hills of the background hide its far edge.
/// The mean albedo near the origin is (0.22, 0.2, 0.17).
void addPreviewGround(render::StageMesh& mesh);

} // namespace fx::cli
