/// @file blob_estimate.h
/// How much the blobs of a frame will cost to draw, and how much of the picture they cover, before they are
/// drawn.
#pragma once

#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/view_block.h"
#include "rendering/passes/blob_instance.h"

#include <span>

namespace fx::render {

/// Fragments of the bounding rectangles of all blobs, clipped to the window, for each of kLayerDivisors.
/// Occlusion by opaque surfaces is ignored.
/// @param width, height of the picture [pixel]
FragmentCounts estimateFragments(std::span<const BlobInstance> blobs, const CameraGeometry& camera, int width,
                                 int height);

/// Approximate share of the picture that the blobs cover, as the weight of their errors. Assumes random
/// positions: 1 - exp(-sum of their areas).
ScreenShare screenShare(std::span<const BlobInstance> blobs, const CameraGeometry& camera);

} // namespace fx::render
