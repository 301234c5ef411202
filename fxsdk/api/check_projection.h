/// @file check_projection.h
/// Tests of projection matrices of the host, column-major float[16].
#pragma once

#include <cstdint>

namespace fx::api {

/// The reason why the matrix is not a camera's projection from eye to clip space, with the remedy; null for a
/// valid projection. Faults: an element is not finite; the matrix is row-major, scaled or singular; the
/// camera looks along +Z; the frustum has no extent. Off-center, jittered, mirrored and oblique projections
/// are accepted.
const char* projectionFault(const float* projection);

/// The reason why a frame cannot be drawn with a matrix that projectionFault() accepts; null if the frame can
/// be drawn. The renderer computes distances and rays from single elements of the matrix. The matrix must
/// therefore contain no part of the view matrix.
/// @param isReversed true: near points have the larger depth value
const char* frameProjectionFault(const float* projection, bool isReversed);

} // namespace fx::api
