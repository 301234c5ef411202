/// @file fragment_estimate.h
/// How much the blobs of a frame will cost to draw, before they are drawn.
#pragma once

#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/view_block.h"
#include "rendering/passes/blob_instance.h"

#include <span>

namespace fx::render {

/// Fragments of the covering rectangles of all blobs, cut by the window, if they were drawn at each of
/// kLayerDivisors. What opaque surfaces hide is not taken off.
/// @param width, height of the picture [pixel]
FragmentCounts estimateFragments(std::span<const BlobInstance> blobs, const CameraGeometry& camera, int width,
                                 int height);

} // namespace fx::render
