/// @file particle_estimate.h
/// Estimates the cost of the particles and ribbons of a group before drawing.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/view_block.h"
#include "rendering/particle_rows/row_technique.h"

namespace fx::render {

/// Estimated number of fragments of all rows, for each of kLayerDivisors. The number of fragments of a row
/// is limited to the size of the window. Every 61st row is evaluated, and represents itself and the next 60
/// rows. Clipping and occlusion are ignored.
/// @param group   group of the technique's kind
/// @param place placement of the group relative to the eye
/// @param width, height [pixel] size of the picture
FragmentCounts estimateRows(const base::SnapshotGroup& group, const RowTechnique& technique,
                            const base::Placement& place, const CameraGeometry& camera, int width,
                            int height);

} // namespace fx::render
