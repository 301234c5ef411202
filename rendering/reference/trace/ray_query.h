/// @file ray_query.h
/// Finds the balls that a single ray meets. The function is intended for rays that are not part of a tile,
/// such as shadow rays.
#pragma once

#include "rendering/reference/trace/ball_tree.h"
#include "rendering/reference/trace/ray_grid.h"
#include "rendering/reference/trace/ray_hits.h"

namespace fx::render {

/// Replaces `out` by all balls that `ray` meets between the parameters `begin` and `end`, sorted by place.
/// TileCandidates::hits() defines when a ray meets a ball.
void findHits(const BallTree& tree, const TraceRay& ray, double begin, double end, RayHits& out);

} // namespace fx::render
