/// @file particle_estimate.h
/// How much the particles and ribbons of a group will cost to draw, before they are drawn.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/view_block.h"
#include "rendering/particle_rows/row_technique.h"

namespace fx::render {

/// Fragments of all rows if they were drawn at each of kLayerDivisors, none counted for more than the window.
/// Only every 61st row is looked at; what the window cuts or opaque surfaces hide is not taken off.
/// @param group   of the technique's kind
/// @param place   where it stands relative to the eye
/// @param width, height of the picture [pixel]
FragmentCounts estimateRows(const base::SnapshotGroup& group, const RowTechnique& technique,
                            const base::Placement& place, const CameraGeometry& camera, int width,
                            int height);

} // namespace fx::render
