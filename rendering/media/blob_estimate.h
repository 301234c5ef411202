/// @file blob_estimate.h
/// Estimates of the cost of the blobs of a frame, and of the fraction of the picture that the blobs cover.
#pragma once

#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/view_block.h"
#include "rendering/passes/blob_instance.h"

#include <span>

namespace fx::render {

/// Number of fragments of the bounding rectangles of all blobs, clipped to the window, for each of
/// kLayerDivisors. Occlusion by opaque surfaces is ignored.
/// @param width, height [pixel] size of the picture
FragmentCounts estimateFragments(std::span<const BlobInstance> blobs, const CameraGeometry& camera, int width,
                                 int height);

/// Approximate fraction of the picture that blobs cover: 1 - exp(-sum of areas), which holds for random
/// positions. The errors of blobs are weighted by this fraction.
ScreenShare screenShare(std::span<const BlobInstance> blobs, const CameraGeometry& camera);

} // namespace fx::render
