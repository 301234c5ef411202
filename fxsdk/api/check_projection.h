/// @file check_projection.h
/// Tests of projection matrices of the host, column-major float[16].
#pragma once

#include <cstdint>

namespace fx::api {

/// Null, or why the matrix is no camera's projection from eye to clip space, with the remedy: not finite,
/// row-major, for a camera that looks along +Z, without extent, scaled, singular. Off-center, jittered,
/// mirrored and oblique ones are good.
const char* projectionFault(const float* projection);

/// Null, or the reason why a frame cannot be drawn with the matrix, although projectionFault() accepts it.
/// Distances and rays of a frame are computed from single elements, so the matrix must contain nothing that
/// belongs into the view matrix.
/// @param isReversed near maps to the larger depth
const char* frameProjectionFault(const float* projection, bool isReversed);

} // namespace fx::api
