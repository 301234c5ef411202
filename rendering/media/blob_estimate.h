/// @file blob_estimate.h
/// How much the blobs of a frame will cost to draw, and how much of the picture they cover, before they are
/// drawn.
#pragma once

#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/screen_share.h"
#include "rendering/frame/view_block.h"
#include "rendering/passes/blob_instance.h"

#include <span>

namespace fx::render {

/// Fragments of the covering rectangles of all blobs, cut by the window, if they were drawn at each of
/// kLayerDivisors. What opaque surfaces hide is not taken off.
/// @param width, height of the picture [pixel]
FragmentCounts estimateFragments(std::span<const BlobInstance> blobs, const CameraGeometry& camera, int width,
                                 int height);

/// About how much of the picture the blobs cover, which tells how much an error in them matters. As if they
/// lay at random places: 1 - exp(-sum of their areas).
ScreenShare screenShare(std::span<const BlobInstance> blobs, const CameraGeometry& camera);

} // namespace fx::render
