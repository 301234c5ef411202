/// @file particle_estimate.h
/// How much the particles and ribbons of a group will cost to draw, before they are drawn.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/view_block.h"
#include "rendering/particle_rows/row_technique.h"

namespace fx::render {

/// Estimated fragments of all rows for each of kLayerDivisors, each row limited to the size of the window.
/// Extrapolated from every 61st row; clipping and occlusion are ignored.
/// @param group   of the technique's kind
/// @param place placement relative to the eye
/// @param width, height of the picture [pixel]
FragmentCounts estimateRows(const base::SnapshotGroup& group, const RowTechnique& technique,
                            const base::Placement& place, const CameraGeometry& camera, int width,
                            int height);

} // namespace fx::render
