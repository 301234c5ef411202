/// @file check_projection.h
/// Tests of projection matrices of the host, column-major float[16].
#pragma once

#include <cstdint>

namespace fx::api {

/// Null, or why the matrix is no camera's projection from eye to clip space, with the remedy: not finite,
/// row-major, for a camera that looks along +Z, without extent, scaled, singular. Off-center, jittered,
/// mirrored and oblique ones are good.
const char* projectionFault(const float* projection);

/// Null, or why a frame cannot be drawn with the matrix, which projectionFault() finds good. Frames read
/// distances and rays from its elements, so what else it does must lie in the view matrix.
/// @param isReversed near maps to the larger depth
const char* frameProjectionFault(const float* projection, bool isReversed);

} // namespace fx::api
