/// @file ray_query.h
/// The balls that a single ray meets, for rays that no tile holds: shadow rays, probes.
#pragma once

#include "rendering/reference/trace/ball_tree.h"
#include "rendering/reference/trace/ray_grid.h"
#include "rendering/reference/trace/ray_hits.h"

namespace fx::render {

/// Replaces `out` by all balls that `ray` meets between the parameters `begin` and `end`, by the same test as
/// TileCandidates::hits(). By rising place.
void findHits(const BallTree& tree, const TraceRay& ray, double begin, double end, RayHits& out);

} // namespace fx::render
